#include "ale/layers/layer_stack.hpp"

#include "core/error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

void check_lines(const LayerInput& in, std::string_view what, const std::vector<double>& lines) {
  if (lines.size() < 2) {
    throw Error(fmt::format("{}: {} needs at least two places, found {}", in.name, what, lines.size()));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::isfinite(lines[i]) || (i > 0 && !(lines[i] > lines[i - 1]))) {
      throw Error(fmt::format("{}: {} must rise; place {} is {} m", in.name, what, i, lines[i]));
    }
  }
}

bool has_edge(const LayerInput& in, int axes, LayerEdge kind) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis) {
    if (in.edge[axis][0] == kind || in.edge[axis][1] == kind) {
      return true;
    }
  }
  return false;
}

void check_axis(const LayerInput& in) {
  const double first = in.lines[0].front();
  if (first < 0) {
    throw Error(fmt::format("{}: radii start at {} m; around an axis they start at 0 or above", in.name, first));
  }
  if (first == 0 && in.edge[0][0] != LayerEdge::symmetry) {
    throw Error(fmt::format("{}: lines[0] starts on the axis: its low edge must be `symmetry`", in.name));
  }
}

void check_input(const LayerInput& in, int dim) {
  if (in.layers < 1 || in.through < 1) {
    throw Error(fmt::format("{}: {} layers of {} elements through; both must be at least 1", in.name, in.layers, in.through));
  }
  check_lines(in, "lines[0]", in.lines[0]);
  check_lines(in, "levels", in.levels);
  if (in.levels.size() != static_cast<std::size_t>(in.layers) * static_cast<std::size_t>(in.through) + 1) {
    throw Error(fmt::format("{}: {} layers of {} elements through need {} levels, found {}", in.name, in.layers, in.through, in.layers * in.through + 1, in.levels.size()));
  }
  if (dim == 3) {
    check_lines(in, "lines[1]", in.lines[1]);
  } else if (!in.lines[1].empty()) {
    throw Error(fmt::format("{}: lines[1] has no meaning in two dimensions; leave it empty", in.name));
  }
  if (in.axisymmetric && dim == 3) {
    throw Error(fmt::format("{}: `axisymmetric` has no meaning in three dimensions", in.name));
  }
  if (in.axisymmetric) {
    check_axis(in);
  }
  const bool elastic = has_edge(in, dim - 1, LayerEdge::elastic);
  if (elastic != (in.edge_stiffness > 0) || !std::isfinite(in.edge_stiffness)) {
    throw Error(fmt::format("{}: edge_stiffness is {} N/m2: positive with elastic edges, 0 without", in.name, in.edge_stiffness));
  }
  const LayerHourglass& h = in.hourglass;
  if (!(h.stiffness >= 0 && h.stiffness <= 1 && h.viscosity >= 0 && h.viscosity <= 0.5)) {
    throw Error(fmt::format("{}: hourglass stiffness {} must lie in 0 to 1, viscosity {} in 0 to 0.5", in.name, h.stiffness, h.viscosity));
  }
  if (!(in.viscosity.quadratic >= 0 && in.viscosity.linear >= 0)) {
    throw Error(fmt::format("{}: viscosity {} and {} must not be negative", in.name, in.viscosity.quadratic, in.viscosity.linear));
  }
  if (!(in.guard.shortest >= 0 && in.guard.shortest < 1 && in.guard.volume >= 0 && in.guard.volume < 1)) {
    throw Error(fmt::format("{}: guard's shortest {} and volume {} must lie in 0 to 1", in.name, in.guard.shortest, in.guard.volume));
  }
}

/// Halves of the intervals beside each line; around an axis whole rings over 2 pi r dr.
std::vector<double> corner_lengths(const std::vector<double>& lines, bool ring) {
  std::vector<double> share(lines.size(), 0.0);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double middle = 0.5 * (lines[i] + lines[i + 1]), half = 0.5 * (lines[i + 1] - lines[i]);
    share[i] += ring ? std::numbers::pi * half * (middle + lines[i]) : half;
    share[i + 1] += ring ? std::numbers::pi * half * (middle + lines[i + 1]) : half;
  }
  return share;
}

LayerRest rest_of_rows(const std::vector<double>& lines, bool ring) {
  LayerRest rest;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double h = lines[i + 1] - lines[i], R = 0.5 * (lines[i] + lines[i + 1]);
    const double inner = 0.5 - h / (8 * R); // share of the ring's mass at its inner nodes
    rest.gradient.push_back(2 / h);
    rest.hoop.push_back(ring ? 1 / R : 0.0);
    rest.span.push_back(ring ? 2 * std::numbers::pi * R * h : h);
    rest.lightest.push_back(ring ? 1 / (4 * inner * (1 - inner)) : 1.0);
  }
  return rest;
}

bool wants_rate(const FabricModel& model) {
  const auto* law = std::get_if<RaftenbergFabric>(&model);
  return law != nullptr && law->rate.has_value();
}

template <int Dim> void allocate(LayerStack<Dim>& s) {
  const std::size_t nodes = s.node(0, 0, s.grid.planes()), elements = s.element(0, 0, s.grid.levels());
  for (std::size_t d = 0; d < Dim; ++d) {
    for (auto* field : {&s.rest, &s.position, &s.velocity, &s.force, &s.kept_velocity}) {
      (*field)[d].assign(nodes, 0.0);
    }
  }
  s.mass.assign(nodes, 0.0);
  for (auto& point : s.largest) {
    for (auto& family : point) {
      family.assign(elements, 0.0);
    }
  }
  if (wants_rate(s.model)) {
    s.rate = s.largest;
  }
  for (auto* field : {&s.energy, &s.hourglass_energy, &s.shock_heat, &s.wave_step, &s.shock_volume}) {
    field->assign(elements, 0.0);
  }
  s.alive.assign(elements, 1);
  s.stress_volume.assign(elements * LayerStack<Dim>::strains, 0.0);
  s.hourglass_volume.assign(elements * LayerStack<Dim>::hourglass_modes, 0.0);
}

/// Rest positions, and masses from the corner lengths along each axis.
template <int Dim> void place_nodes(LayerStack<Dim>& s) {
  const std::vector<double> along = corner_lengths(s.lines[0], s.axisymmetric);
  const std::vector<double> across = Dim == 3 ? corner_lengths(s.lines[1], false) : std::vector<double>{1.0};
  for (int plane = 0; plane < s.grid.planes(); ++plane) {
    const int in_layer = plane % (s.grid.through + 1);
    const std::size_t level = static_cast<std::size_t>(plane / (s.grid.through + 1) * s.grid.through + in_layer);
    const double below = in_layer > 0 ? s.levels[level] - s.levels[level - 1] : 0.0;
    const double above = in_layer < s.grid.through ? s.levels[level + 1] - s.levels[level] : 0.0;
    for (std::size_t j = 0; j < across.size(); ++j) {
      for (std::size_t i = 0; i < along.size(); ++i) {
        const std::size_t n = s.node(static_cast<int>(i), static_cast<int>(j), plane);
        s.rest[0][n] = s.lines[0][i];
        if (Dim == 3) {
          s.rest[1][n] = s.lines[1][j];
        }
        s.rest[Dim - 1][n] = s.levels[level];
        s.mass[n] = s.density * along[i] * across[j] * 0.5 * (below + above);
      }
    }
  }
  s.position = s.rest;
}

} // namespace

template <int Dim> LayerStack<Dim> make_stack(const LayerInput& input) {
  check_input(input, Dim);
  check(input.model, input.name);
  LayerStack<Dim> s;
  s.name = input.name;
  s.grid = {{static_cast<int>(input.lines[0].size()) - 1, Dim == 3 ? static_cast<int>(input.lines[1].size()) - 1 : 1}, input.layers, input.through};
  s.axisymmetric = input.axisymmetric;
  s.model = input.model;
  s.density = density(input.model);
  s.hourglass = input.hourglass;
  s.guard = input.guard;
  s.viscosity = input.viscosity;
  s.edge = input.edge;
  s.edge_stiffness = input.edge_stiffness;
  s.lines = input.lines;
  s.levels = input.levels;
  s.at_rest = rest_of_rows(s.lines[0], s.axisymmetric);
  allocate(s);
  place_nodes(s);
  return s;
}

template LayerStack<2> make_stack<2>(const LayerInput&);
template LayerStack<3> make_stack<3>(const LayerInput&);

std::vector<double> even_lines(double from, double to, int elements) {
  std::vector<double> lines(static_cast<std::size_t>(elements) + 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double part = static_cast<double>(i) / elements;
    lines[i] = from + (to - from) * part;
  }
  return lines;
}

} // namespace ballast
