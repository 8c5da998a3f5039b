#include "synthetic_series.hpp"

#include <algorithm>
#include <cmath>

#include "core/io/history.hpp"

namespace ballast::io::synthetic {
namespace {

struct Vertex {
  double r, z;
};
using Shape = std::vector<Vertex>;

/// The part of `shape` where a r + b z < c (Sutherland-Hodgman).
Shape cut(const Shape& shape, double a, double b, double c) {
  Shape kept;
  for (std::size_t v = 0; v < shape.size(); ++v) {
    const Vertex &p = shape[v], &q = shape[(v + 1) % shape.size()];
    const double dp = a * p.r + b * p.z - c, dq = a * q.r + b * q.z - c;
    if (dp < 0)
      kept.push_back(p);
    if ((dp < 0) != (dq < 0))
      kept.push_back({p.r + dp / (dp - dq) * (q.r - p.r), p.z + dp / (dp - dq) * (q.z - p.z)});
  }
  return kept;
}

void add_polygon(GridDump::Polygons& polygons, const Shape& shape, int material) {
  if (shape.size() < 3)
    return;
  for (const Vertex& v : shape)
    polygons.points.insert(polygons.points.end(), {v.r, v.z, 0});
  polygons.sizes.push_back(static_cast<int>(shape.size()));
  polygons.material.push_back(material);
}

struct State {
  float pressure, speed, material;
};

/// A bow shock ahead of the disc, tension behind it, and the disc's own speed.
State state_at(const DiscScene& scene, double time, double r, double z) {
  const double disc = scene.disc_z(time), dz = z - disc, distance = std::hypot(r, dz);
  if (distance < scene.radius)
    return {2.0e8F, static_cast<float>(scene.speed), 2};
  if (z < scene.gel_front)
    return {1e5F, 0, 0};
  const double contact = scene.gel_front - scene.radius - scene.z_start,
               path = 1500 * (time - contact / scene.speed);
  if (path < 0)
    return {1e5F, 0, 1};
  const double shock = std::exp(-std::pow((std::hypot(r, z) - path) / 0.0015, 2)),
               near = std::pow(scene.radius / distance, 2);
  const double pressure =
      4e8 * shock * scene.radius / (scene.radius + path) + 6e8 * near * (dz > 0 ? 1 : -0.4);
  return {
      static_cast<float>(pressure), static_cast<float>(scene.speed * near * 0.8 + 40 * shock), 1};
}

void add_mixed(GridDump::Polygons& polygons,
               const DiscScene& scene,
               double time,
               const Shape& cell) {
  double r = 0, z = 0;
  for (const Vertex& v : cell)
    r += v.r / 4, z += v.z / 4;
  const double disc = scene.disc_z(time), angle = std::atan2(z - disc, r), a = std::cos(angle),
               b = std::sin(angle);
  const double c = scene.radius + b * disc;
  const Shape inside = cut(cell, a, b, c), outside = cut(cell, -a, -b, -c);
  if (inside.empty() || outside.empty())
    return;
  add_polygon(polygons, inside, 2);
  add_polygon(polygons, cut(outside, 0, 1, scene.gel_front), 0);
  add_polygon(polygons, cut(outside, 0, -1, -scene.gel_front), 1);
}

} // namespace

GridDump disc_dump(const DiscScene& scene, double time) {
  GridDump dump;
  dump.block = "ale";
  dump.geometry = "axisymmetric";
  dump.cells = {scene.nr, scene.nz, 0};
  dump.material_names = {"air", "gel", "lead", "kevlar"};
  const double dr = scene.r_end / scene.nr, dz = (scene.z_end - scene.z_begin) / scene.nz;
  for (int j = 0; j <= scene.nz; ++j)
    for (int i = 0; i <= scene.nr; ++i)
      dump.points.insert(dump.points.end(), {i * dr, scene.z_begin + j * dz, 0});
  dump.cell_arrays = {{"pressure", 1, {}}, {"speed", 1, {}}, {"material", 1, {}}};
  for (int j = 0; j < scene.nz; ++j)
    for (int i = 0; i < scene.nr; ++i) {
      const double r = i * dr, z = scene.z_begin + j * dz;
      const State state = state_at(scene, time, r + dr / 2, z + dz / 2);
      dump.cell_arrays[0].values.push_back(state.pressure);
      dump.cell_arrays[1].values.push_back(state.speed);
      dump.cell_arrays[2].values.push_back(state.material);
      add_mixed(dump.material_polygons,
                scene,
                time,
                {{r, z}, {r + dr, z}, {r + dr, z + dz}, {r, z + dz}});
    }
  return dump;
}

GridDump plate_dump(const DiscScene& scene, double time) {
  GridDump dump;
  dump.block = "vest";
  dump.geometry = "axisymmetric";
  dump.cells = {40, 3, 0};
  dump.material_names = {"air", "gel", "lead", "kevlar"};
  const double push = std::max(0.0, scene.disc_z(time) + scene.radius + 0.003);
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 40; ++i) {
      const double r = 0.02 * i / 40;
      dump.points.insert(dump.points.end(),
                         {r, -0.003 + 0.0005 * j + push * std::exp(-r / 0.006 * r / 0.006), 0});
    }
  const std::size_t cells = 120;
  dump.cell_arrays = {{"pressure", 1, std::vector<float>(cells, -1e8F)},
                      {"speed", 1, std::vector<float>(cells, 120)},
                      {"material", 1, std::vector<float>(cells, 3)}};
  return dump;
}

void write_run(const std::filesystem::path& dir, const DiscScene& scene, int times) {
  VtkSeries series(dir, "fields");
  for (int k = 0; k < times; ++k) {
    const double time = scene.end_time * k / (times - 1);
    series.write(time, k, {disc_dump(scene, time), plate_dump(scene, time)});
  }
  HistoryWriter history(dir / "history.csv",
                        {"velocity_bullet [m/s]",
                         "velocity_vest [m/s]",
                         "pressure_behind_the_vest [Pa]",
                         "energy_kinetic [J]",
                         "energy_internal [J]",
                         "energy_total [J]",
                         "dt [s]",
                         "cells_awake"});
  for (int k = 0; k <= 400; ++k) {
    const double t = scene.end_time * k / 400, slow = std::exp(-t / 60e-6),
                 kinetic = 900 * slow * slow;
    const double gauge =
        4e8 * std::exp(-std::pow((t - 15e-6) / 3e-6, 2)) * std::cos((t - 15e-6) / 2e-6);
    history.add(t,
                std::vector<double>{scene.speed * slow,
                                    300 * (1 - slow),
                                    gauge,
                                    kinetic,
                                    900 - kinetic,
                                    900,
                                    2e-8 * (1 + 0.1 * slow),
                                    100.0 + k});
  }
}

} // namespace ballast::io::synthetic
