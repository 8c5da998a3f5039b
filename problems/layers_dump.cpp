#include "problems/layers_dump.hpp"

#include "ale/layers/layer_rows.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {
namespace {

using namespace layer_element;

/// Values of one element, in the order of `value_names`.
constexpr std::size_t value_count = 10;
using Values = std::array<double, value_count>;
constexpr std::array<const char*, value_count> value_names = {"speed",     "layer",     "green_strain_11", "green_strain_22", "green_strain_33",
                                                              "stress_11", "stress_22", "stress_33",       "damage_warp",     "damage_fill"};

std::array<double, 2> rupture_strains(const FabricModel& model) {
  const auto* law = std::get_if<RaftenbergFabric>(&model);
  constexpr double never = std::numeric_limits<double>::infinity();
  return law != nullptr ? std::array<double, 2>{law->warp.rupture, law->fill.rupture} : std::array<double, 2>{never, never};
}

/// Nodes of an element in VTK's order: around the lower face, then the upper.
template <int Dim> std::vector<std::size_t> corners_of(const LayerStack<Dim>& s, int i, int j, int level) {
  const int p = s.plane_below(level);
  if constexpr (Dim == 3) {
    std::vector<std::size_t> out;
    for (int up = 0; up < 2; ++up) {
      out.insert(out.end(), {s.node(i, j, p + up), s.node(i + 1, j, p + up), s.node(i + 1, j + 1, p + up), s.node(i, j + 1, p + up)});
    }
    return out;
  } else {
    return {s.node(i, j, p), s.node(i + 1, j, p), s.node(i + 1, j, p + 1), s.node(i, j, p + 1)};
  }
}

template <int Dim> double speed_of(const LayerStack<Dim>& s, const std::vector<std::size_t>& corners) {
  double square = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    double sum = 0;
    for (const std::size_t n : corners) {
      sum += s.velocity[d][n] / static_cast<double>(corners.size());
    }
    square += sum * sum;
  }
  return std::sqrt(square);
}

template <int Dim> Values values_of(const LayerStack<Dim>& s, int i, int j, int level) {
  const RowSizes sizes = row_sizes(s, j, level);
  const Strains<Dim> E = strains(modes_at(node_rows(s, s.position, j, level), i), sizes.gradients(i, Dim == 3));
  const auto Q = element_rows<Count<Dim>::strains>(s, s.stress_volume, j, level);
  const double V = sizes.volume(i);
  constexpr std::size_t at33 = Dim == 3 ? static_cast<std::size_t>(s33) : static_cast<std::size_t>(e33);
  const std::size_t e = s.element(i, j, level);
  const auto rupture = rupture_strains(s.model);
  const auto damage = [&](std::size_t family) { return std::max(s.largest[0][family][e], s.largest[1][family][e]) / rupture[family]; };
  return {speed_of(s, corners_of(s, i, j, level)),
          static_cast<double>(level / s.grid.through),
          0.5 * (E[s11_low] + E[s11_up]),
          0.5 * (E[s22_low] + E[s22_up]),
          E[at33],
          (Q[s11_low][i] + Q[s11_up][i]) / V,
          (Q[s22_low][i] + Q[s22_up][i]) / V,
          Q[at33][i] / V,
          damage(0),
          damage(1)};
}

template <int Dim> std::vector<float> vectors(const LayerStack<Dim>& s, const std::array<std::vector<double>, Dim>& field, const std::array<std::vector<double>, Dim>* from) {
  std::vector<float> out;
  out.reserve(3 * s.node_count());
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      out.push_back(d < Dim ? static_cast<float>(field[d][n] - (from != nullptr ? (*from)[d][n] : 0.0)) : 0.0F);
    }
  }
  return out;
}

template <int Dim> io::ElementDump dump_stack(const LayerStack<Dim>& s, int material) {
  io::ElementDump dump;
  dump.block = s.name;
  dump.geometry = Dim == 3 ? "3d" : s.axisymmetric ? "axisymmetric" : "planar";
  dump.corners = Dim == 3 ? 8 : 4;
  for (std::size_t axis = 0; axis < 2 && Dim == 3; ++axis) {
    if (s.edge[axis][0] == LayerEdge::symmetry && s.lines[axis].front() == 0) {
      dump.symmetry.push_back(std::string(1, "xy"[axis]));
    }
  }
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      dump.points.push_back(d < Dim ? s.position[d][n] : 0.0);
    }
  }
  dump.point_arrays = {{"velocity", 3, vectors<Dim>(s, s.velocity, nullptr)}, {"displacement", 3, vectors<Dim>(s, s.position, &s.rest)}};
  std::array<std::vector<float>, value_count> values;
  std::vector<float> section;
  for (int level = 0; level < s.grid.levels(); ++level) {
    for (int j = 0; j < s.grid.elements[1]; ++j) {
      for (int i = 0; i < s.grid.elements[0]; ++i) {
        if (s.alive[s.element(i, j, level)] == 0) {
          continue;
        }
        for (const std::size_t n : corners_of(s, i, j, level)) {
          dump.elements.push_back(static_cast<int>(n));
        }
        const Values v = values_of(s, i, j, level);
        for (std::size_t k = 0; k < value_count; ++k) {
          values[k].push_back(static_cast<float>(v[k]));
        }
        section.push_back(Dim == 3 && s.lines[1][static_cast<std::size_t>(j)] == 0 ? 1.0F : 0.0F);
      }
    }
  }
  dump.cell_arrays.push_back({"material", 1, std::vector<float>(section.size(), static_cast<float>(material))});
  for (std::size_t k = 0; k < value_count; ++k) {
    dump.cell_arrays.push_back({value_names[k], 1, std::move(values[k])});
  }
  if (Dim == 3) {
    dump.cell_arrays.push_back({"section", 1, std::move(section)});
  }
  return dump;
}

} // namespace

template <int Dim> std::vector<io::ElementDump> dump_layers(std::span<const LayerStack<Dim>* const> stacks, const std::vector<std::string>& material_names) {
  std::vector<std::string> names = material_names;
  for (const LayerStack<Dim>* s : stacks) {
    names.push_back(s->name);
  }
  std::vector<io::ElementDump> dumps;
  for (const LayerStack<Dim>* s : stacks) {
    dumps.push_back(dump_stack(*s, static_cast<int>(material_names.size() + dumps.size())));
    dumps.back().material_names = names;
  }
  return dumps;
}

template std::vector<io::ElementDump> dump_layers<2>(std::span<const LayerStack<2>* const>, const std::vector<std::string>&);
template std::vector<io::ElementDump> dump_layers<3>(std::span<const LayerStack<3>* const>, const std::vector<std::string>&);

} // namespace ballast
