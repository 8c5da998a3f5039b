#include "problems/scene_report.hpp"

#include "problems/layers_report.hpp"
#include "problems/mapped_fractions.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

/// Calls visit(lo, hi) for every cell whose place overlaps `b` (of a mapped mesh for every cell), in logical coordinates.
template <class Visit> void for_cells(const SceneSpec& scene, const Bounds& b, Visit visit) {
  std::array<std::pair<std::size_t, std::size_t>, 3> range{{{0, 1}, {0, 1}, {0, 1}}};
  const auto dim = static_cast<std::size_t>(dimensions(scene.geometry));
  for (std::size_t k = 0; k < dim; ++k) {
    const auto& x = scene.mesh_lines[k];
    if (scene.map.curved()) {
      range[k] = {0, x.size() - 1};
      continue;
    }
    const auto first = std::upper_bound(x.begin(), x.end(), b.lo[k]) - x.begin();
    const auto last = std::lower_bound(x.begin(), x.end(), b.hi[k]) - x.begin();
    range[k] = {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - 1)),
                std::min(x.size() - 1, static_cast<std::size_t>(last))};
  }
  Point lo{}, hi{};
  const auto place = [&](std::size_t axis, std::size_t i) {
    if (axis < dim) {
      lo[axis] = scene.mesh_lines[axis][i];
      hi[axis] = scene.mesh_lines[axis][i + 1];
    }
  };
  for (std::size_t k = range[2].first; k < range[2].second; ++k) {
    place(2, k);
    for (std::size_t j = range[1].first; j < range[1].second; ++j) {
      place(1, j);
      for (std::size_t i = range[0].first; i < range[0].second; ++i) {
        place(0, i);
        visit(lo, hi);
      }
    }
  }
}

std::string boundary_text(const Boundary& b, const SceneSpec& scene) {
  switch (b.kind) {
  case BoundaryKind::symmetry:
    return "symmetry";
  case BoundaryKind::free:
    return "free";
  case BoundaryKind::wall:
    return b.wall_velocity == 0 ? "wall" : fmt::format("wall at {:g} m/s", b.wall_velocity);
  case BoundaryKind::inflow:
    return fmt::format("inflow of {}", scene.materials[static_cast<std::size_t>(b.material)].name);
  case BoundaryKind::absorbing:
    return "absorbing";
  case BoundaryKind::outflow:
    break;
  }
  return "outflow";
}

std::string mesh_table(const SceneSpec& scene) {
  std::string out = fmt::format("mesh: {} cells{}\n", cell_count(scene), scene.map.curved() ? ", curvilinear" : "");
  const std::vector<std::string> names = mesh_axis_names(scene);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto& x = scene.mesh_lines[k];
    double smallest = x.back() - x.front(), largest = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      smallest = std::min(smallest, x[i + 1] - x[i]);
      largest = std::max(largest, x[i + 1] - x[i]);
    }
    const Dimension dimension = mesh_axis_dimension(scene.map, static_cast<int>(k));
    const double per_unit = dimension == Dimension::length ? 1e3 : dimension == Dimension::angle ? 180 / std::numbers::pi : 1;
    const char* unit = dimension == Dimension::length ? " mm" : dimension == Dimension::angle ? " deg" : "";
    out += fmt::format("  {}  {:9.3f} to {:9.3f}{}  {:6} cells of {:.4g} to {:.4g}{}  {} | {}\n",
                       names[k],
                       x.front() * per_unit,
                       x.back() * per_unit,
                       unit,
                       x.size() - 1,
                       smallest * per_unit,
                       largest * per_unit,
                       unit,
                       boundary_text(scene.boundaries[k][0], scene),
                       boundary_text(scene.boundaries[k][1], scene));
  }
  return out;
}

std::string material_table(const SceneSpec& scene) {
  std::string out = "materials\n";
  for (const Material& m : scene.materials) {
    out += fmt::format(
        "  {:<16} {:9.4g} kg/m3  {}; strength: {}{}{}  [{}]\n",
        m.name,
        m.density,
        describe(m.eos),
        describe(m.strength),
        m.failure ? fmt::format("; failure: {}", describe(*m.failure)) : "",
        std::isfinite(m.spall_pressure) ? fmt::format("; spall {:.3g} Pa", m.spall_pressure) : "",
        m.confidence);
  }
  return out + fmt::format("  background: {}\n",
                           scene.background < 0
                               ? "void"
                               : scene.materials[static_cast<std::size_t>(scene.background)].name);
}

std::string body_table(const SceneSpec& scene) {
  const std::vector<Filled> filled = filled_bodies(scene);
  const bool planar = scene.geometry == Geometry::planar;
  std::string out = fmt::format(
      "bodies (later ones replace earlier ones){}\n",
      scene.geometry == Geometry::three_d ? "; masses are of the part inside the mesh" : "");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& b = scene.bodies[i];
    const double speed = std::hypot(b.velocity[0], b.velocity[1], b.velocity[2]);
    const std::string radial = b.radial ? fmt::format(", radially {:g} m/s{}", b.radial->speed, b.radial->power == 0 ? "" : fmt::format(" at {:g} mm", b.radial->at * 1e3)) : "";
    out += fmt::format("  {:<16} {:<16} {:12.6g} {}  {:8.4g} m/s  {:.5g} J{}  {}\n",
                       b.name,
                       b.material < 0 ? "void"
                                      : scene.materials[static_cast<std::size_t>(b.material)].name,
                       filled[i].mass * (planar ? 1 : 1e3),
                       planar ? "kg/m" : "g",
                       speed,
                       0.5 * filled[i].mass * speed * speed,
                       radial,
                       describe(b.shape));
  }
  const Bounds mesh = mesh_bounds(scene);
  const double nothing = 1e-12 * cell_volume(scene.geometry, mesh.lo, mesh.hi);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (filled[i].volume <= nothing) {
      out += fmt::format("  warning: body \"{}\" fills nothing of the mesh: later bodies cover it, or it lies beside it\n", scene.bodies[i].name);
    }
  }
  return out;
}

std::string numerics_line(const SceneSpec& scene) {
  const char* closures[] = {"pressure relaxation", "Tipton", "equal strain"};
  const char* normals[] = {"ELVIRA", "mixed Youngs-centred", "Youngs"};
  const std::string motion =
      scene.motion.policy == MotionPolicy::lagrangian
          ? "never remapped"
      : scene.motion.remap_quality > 0
          ? fmt::format("remapped when a cell's shape falls below {:g}", scene.motion.remap_quality)
          : fmt::format("remapped every {} step(s)", scene.motion.remap_every);
  std::string goes;
  if (scene.motion.policy == MotionPolicy::follow) {
    const std::vector<std::string> names = axis_names(scene.geometry);
    for (const int m : scene.motion.leaders) {
      goes += (goes.empty() ? ", the mesh goes with " : " ") + scene.materials[static_cast<std::size_t>(m)].name;
    }
    for (std::size_t d = 0; d < names.size(); ++d) {
      goes += scene.motion.axes[d] ? fmt::format(" along {}", names[d]) : "";
      goes += scene.motion.stretches[d] ? fmt::format(", stretched along {}", names[d]) : "";
    }
  }
  if (scene.motion.policy == MotionPolicy::relax) {
    goes = fmt::format(", smoothed by {} sweeps, boundary {}", scene.motion.sweeps, scene.motion.fixed_boundary ? "fixed" : "lagrangian");
  }
  std::string slides;
  for (const int m : scene.sliding) {
    slides += (slides.empty() ? ", slides: " : " ") + scene.materials[static_cast<std::size_t>(m)].name;
  }
  return fmt::format("numerics: {}, cfl {:g}, closure {}, normals {}{}\n",
                     motion + goes,
                     scene.numerics.cfl,
                     closures[static_cast<int>(scene.numerics.closure)],
                     normals[static_cast<int>(scene.numerics.normal)],
                     slides);
}

} // namespace

double cell_volume(Geometry geometry, const Point& lo, const Point& hi) {
  const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]);
  switch (geometry) {
  case Geometry::planar:
    return area;
  case Geometry::axisymmetric:
    return area * std::numbers::pi * (lo[0] + hi[0]);
  case Geometry::three_d:
    break;
  }
  return area * (hi[2] - lo[2]);
}

std::vector<Filled> filled_bodies(const SceneSpec& scene) {
  std::vector<Filled> filled(scene.bodies.size());
  std::vector<const Shape*> above;
  std::vector<double> shares;
  for (std::size_t i = scene.bodies.size(); i-- > 0;) {
    above.insert(above.begin(), &scene.bodies[i].shape); // this body and those that replace it
    shares.resize(above.size());
    for_cells(scene, bounds(scene.bodies[i].shape), [&](const Point& lo, const Point& hi) {
      if (scene.map.curved()) {
        mapped_fractions(above, scene.map, scene.geometry, lo, hi, shares);
        filled[i].volume += shares[0] * mapped_cell_volume(scene.map, scene.geometry, lo, hi);
      } else {
        visible_fractions(above, scene.geometry, lo, hi, shares);
        filled[i].volume += shares[0] * cell_volume(scene.geometry, lo, hi);
      }
    });
    filled[i].mass = filled[i].volume * scene.bodies[i].density;
  }
  return filled;
}

double estimated_steps(const SceneSpec& scene) {
  double fastest = 0;
  for (const Body& b : scene.bodies) {
    if (b.material >= 0) {
      const Material& m = scene.materials[static_cast<std::size_t>(b.material)];
      const double c2 = sound_speed_squared(m.eos, b.density, b.specific_energy) +
                        4.0 / 3.0 * shear_modulus(m.strength) / b.density;
      fastest = std::max(fastest, std::sqrt(c2));
    }
  }
  double smallest = std::numeric_limits<double>::infinity();
  if (scene.map.curved()) {
    for_cells(scene, {}, [&](const Point& lo, const Point& hi) { smallest = std::min(smallest, mapped_cell_size(scene.map, scene.geometry, lo, hi)); });
  }
  for (const auto& x : scene.mesh_lines) {
    for (std::size_t i = 0; i + 1 < x.size() && !scene.map.curved(); ++i) {
      smallest = std::min(smallest, x[i + 1] - x[i]);
    }
  }
  return fastest > 0 ? scene.end_time * fastest / (scene.numerics.cfl * smallest) : 0;
}

Cost estimated_cost(const SceneSpec& scene) {
  const int dim = scene.geometry == Geometry::three_d ? 3 : 2;
  const bool strength = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return has_strength(m.strength); });
  const bool mixed = scene.materials.size() > 1 || scene.background < 0;
  Cost c;
  c.steps = estimated_steps(scene);
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
    c.cells *= static_cast<double>(scene.mesh_lines[d].size() - 1);
  }
  const int deviator = strength ? (dim == 2 ? 3 : 5) : 0;
  // Of the block: nodes 5 vectors and 3 masses, cells 7 scalars, 5 a logical axis, the deviator and two moduli; of
  // its materials what one fills a cell with, conserved twice, derived once.
  const int block = 5 * dim + 3 + 7 + 5 * dim + deviator + (strength ? 2 : 0);
  const bool breaks = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.failure.has_value(); });
  int memory = 0; // of tissue: free energy and tensors of four components, in space six
  for (const Material& m : scene.materials) {
    const TissueLaw* law = tissue_law(m.strength);
    memory = std::max(memory, law != nullptr ? 1 + static_cast<int>(state_count(*law)) / 6 * (dim == 2 ? 4 : 6) : 0);
  }
  const int material = 2 * (3 + deviator + (strength ? 1 : 0) + (breaks ? 1 : 0) + memory) + (strength ? 3 : 2);
  const int sliding = scene.sliding.empty() ? 0 : 5 * dim + 4; // nodes 4 vectors and 2 scalars, cells a vector and 2 scalars
  c.bytes_per_cell = 8.0 * (block + material + sliding);
  // Measured microseconds a cell-step on one core (docs/performance.md); cells with several materials cost more.
  double microseconds = dim == 2 ? (strength ? 0.45 : 0.15) : (strength ? 0.7 : 0.35);
  if (scene.motion.policy == MotionPolicy::lagrangian) {
    microseconds *= 0.5;
  } else {
    microseconds *= mixed ? 1.6 : 1;
  }
  c.core_seconds = 1e-6 * microseconds * c.cells * c.steps;
  return c;
}

namespace {
std::string spoken_time(double seconds) {
  return seconds < 90 ? fmt::format("{:.2g} s", seconds) : seconds < 5400 ? fmt::format("{:.2g} min", seconds / 60) : fmt::format("{:.2g} h", seconds / 3600);
}
} // namespace

std::string scene_table(const SceneSpec& scene) {
  std::string out = fmt::format("{}\n{}, to {:g} us, ambient {:g} Pa, {:g} K\n",
                                scene.title,
                                name_of(scene.geometry),
                                scene.end_time * 1e6,
                                scene.ambient_pressure,
                                scene.ambient_temperature);
  out += mesh_table(scene) + material_table(scene) + body_table(scene) + layers_table(scene) + numerics_line(scene);
  for (const Gauge& g : scene.gauges) {
    out += fmt::format("gauge \"{}\" at ({:g}, {:g}, {:g}) m, {}\n",
                       g.name,
                       g.at[0],
                       g.at[1],
                       g.at[2],
                       g.rides ? "rides with the material" : "fixed");
  }
  if (scene.injury) {
    out += fmt::format("injury measures along {}{}, recorded every {:g} s; research output, not medical advice\n", scene.injury->direction > 0 ? "+" : "-",
                       axis_names(scene.geometry)[static_cast<std::size_t>(scene.injury->axis)], scene.injury->record_every);
  }
  const Cost cost = estimated_cost(scene);
  return out + fmt::format("about {:.0f} steps, {:.0f} bytes a cell ({:.3g} MB), {} on one core\n", cost.steps, cost.bytes_per_cell,
                           cost.bytes_per_cell * cost.cells * 1e-6, spoken_time(cost.core_seconds));
}

} // namespace ballast
