// Two waters and a plate between them that lies anyhow in the mesh, shared by the tests of embedding.
#pragma once

#include "tests/embed/channel.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {

/// Two waters, one on each side of a plate in a box, turned by `angle` from x to the last axis about (x, ..., z), in 3D then by `about` from x to y; the plate is wider
/// than it, so that its ends lie outside.
struct WaterBox {
  double cell = 1e-3, width = 12e-3, height = 60e-3;
  double angle = std::numbers::pi / 6, x = 6e-3, z = 30e-3, thickness = 3e-3, pressure = 0, density = 1e8, young = 1e13;
  double reference = 0; ///< Pa: forces are against it
  double reaches = 1;   ///< m: farther from the layer is void
  bool carried = false; ///< the waters move with the layer
  double about = 0.7;
  int elements = 40; ///< of the plate along an axis
};

/// From the plate's axes to the mesh's.
template <int Dim> std::array<double, Dim> turned(const WaterBox& box, std::array<double, Dim> x) {
  const double along = x[0], across = x[Dim - 1];
  x[0] = std::cos(box.angle) * along - std::sin(box.angle) * across;
  x[Dim - 1] = std::sin(box.angle) * along + std::cos(box.angle) * across;
  if constexpr (Dim == 3) {
    const double u = x[0], v = x[1];
    x[0] = std::cos(box.about) * u - std::sin(box.about) * v;
    x[1] = std::sin(box.about) * u + std::cos(box.about) * v;
  }
  return x;
}

/// `along` the plate's first axis, `up`, both m/s; `spin` in its plane of turning, 1/s.
template <int Dim> Scene<Dim> two_waters(const WaterBox& box, double along, double up, double spin) {
  constexpr std::size_t last = Dim - 1;
  Scene<Dim> scene;
  Block<Dim> b;
  b.motion = {MotionPolicy::eulerian, 1};
  b.reference_pressure = box.reference;
  const double rho = 1000 * std::pow(1 + box.pressure / 6e8, 1 / 4.4), e = (box.pressure + 4.4 * 6e8) / (3.4 * rho);
  Material water = channel_water();
  water.density = rho;
  water.specific_energy = e;
  for (const char* name : {"below", "above"}) {
    water.name = name;
    b.materials.push_back(make_slot(water, box.reference));
  }
  b.materials.push_back(make_void());
  const int nx = static_cast<int>(std::lround(box.width / box.cell)), nz = static_cast<int>(std::lround(box.height / box.cell));
  std::array<std::vector<double>, 3> lines;
  lines.fill(even_lines(0, box.width, nx));
  lines[last] = even_lines(0, box.height, nz);
  if (Dim == 2) {
    lines[2].clear();
  }
  allocate_block(b, lines);
  std::array<double, Dim> middle{}, normal{};
  middle.fill(box.x);
  middle[last] = box.z;
  normal[last] = 1;
  normal = turned<Dim>(box, normal);
  double width = 0; // of a cell across the plate
  for (const double n : normal) {
    width += std::abs(n) * box.cell;
  }
  const double padded = std::max(0.0, 1.4 * width - box.thickness); // below (ale/embed/layer_body)
  for_each_cell(b, [&](int i, int j, int k) {
    const std::array<int, 3> at = {i, j, k};
    double above = 0, z = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      z = (at[d] + 0.5) * box.cell - middle[d];
      above += normal[d] * z;
    }
    const bool is_void = std::abs(z) > box.reaches;
    const CellPart part{is_void ? 2 : above > -padded / 2 ? 1 : 0, 1, is_void ? 0 : rho, is_void ? 0 : e};
    fill_cell<Dim>(b, i, j, k, std::span(&part, 1));
  });
  set_velocity(b, [&](const std::array<double, Dim>& x, std::array<double, Dim>& u) {
    u = {};
    u[last] = box.carried && std::abs(x[last] - box.z) < box.reaches ? up : 0.0;
  });
  b.boundary.normal = {{{0, 0}, {1, 1}, {2, 2}}};
  for (auto& axis : b.boundary.side) {
    for (auto& side : axis) {
      side = {BoundaryKind::symmetry, 0};
    }
  }
  scene.blocks.push_back(std::move(b));
  const double half = 1.5 * std::hypot(box.width, box.height);
  LayerInput in;
  in.model = HookeSolid{box.young, 0.3, box.density};
  const bool flat = box.angle == 0; // made in its place: moved there it would be strained by rounding
  const double x0 = flat ? box.x : 0, z0 = flat ? box.z : 0;
  for (std::size_t d = 0; d < last; ++d) {
    in.lines[d] = even_lines(x0 - half, x0 + half, box.elements);
  }
  in.levels = even_lines(z0 - box.thickness / 2, z0 + box.thickness / 2, 1);
  Layers<Dim> l;
  l.stack = make_stack<Dim>(in);
  const std::array<double, Dim> speed = turned<Dim>(box, {along});
  for (std::size_t n = 0; n < l.stack.node_count(); ++n) {
    std::array<double, Dim> off{};
    for (std::size_t d = 0; d < Dim; ++d) {
      off[d] = l.stack.rest[d][n] - (d == last ? z0 : x0);
    }
    off = turned<Dim>(box, off);
    for (std::size_t d = 0; d < Dim; ++d) {
      l.stack.position[d][n] = flat ? l.stack.rest[d][n] : middle[d] + off[d];
      l.stack.velocity[d][n] = speed[d] + (d == 0 ? -spin * off[last] : 0.0) + (d == last ? up + spin * off[0] : 0.0);
    }
  }
  scene.layers.push_back(std::move(l));
  scene.numerics.energy_return = false;
  embed(scene);
  return scene;
}

/// Volume (m2, m3) of cells where both waters are, the lesser share of them.
template <int Dim> double mixed(const Block<Dim>& b) {
  double sum = 0;
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    sum += b.volume.row(r)[i] * std::min(b.materials[0].store.row(field::fraction, r)[i], b.materials[1].store.row(field::fraction, r)[i]);
  });
  return sum;
}

template <int Dim> double fastest(const Block<Dim>& b) {
  double most = 0;
  for (int k = 0; k <= (Dim == 3 ? b.grid.cells[2] : 0); ++k) {
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        for (const RowField& u : b.velocity) {
          most = std::max(most, std::abs(u.row(b.grid.node_row(j, k))[i]));
        }
      }
    }
  }
  return most;
}

template <int Dim> void go(Scene<Dim>& scene, double end) {
  Clock clock;
  clock.end_time = end;
  EXPECT_TRUE(run(scene, clock));
}

template <int Dim> void expect_tight(const Scene<Dim>& scene, const Totals& start, double cell = 1e-3) {
  const Totals end = totals(scene.blocks[0]);
  for (const std::size_t m : {0UL, 1UL}) {
    EXPECT_NEAR(end.mass[m], start.mass[m], 1e-12 * start.mass[m] + scene.ledger.sliver_mass); // of both
    EXPECT_LT(scene.ledger.sliver_mass, 1e-9 * start.mass[m]);
  }
  EXPECT_LT(mixed(scene.blocks[0]), 1e-6 * std::pow(cell, Dim)); // a millionth of a cell, what fractions are rounded to
}

} // namespace ballast
