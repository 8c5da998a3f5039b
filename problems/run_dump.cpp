#include "problems/run_dump.hpp"

#include "ale/fill.hpp"
#include "problems/section_polygons.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

template <int Dim> class Dumper {
public:
  Dumper(const Block<Dim>& block, io::GridDump& dump) : b_(block), d_(dump), cells_(static_cast<std::size_t>(block.grid.cell_count())) {}

  /// value(r, i) for every cell.
  template <class Value> void cells(const std::string& name, Value&& value) {
    std::vector<float> v;
    v.reserve(cells_);
    for_each_cell(b_, [&](int i, int j, int k) { v.push_back(static_cast<float>(value(b_.grid.cell_row(j, k), i))); });
    d_.cell_arrays.push_back({name, 1, std::move(v)});
  }
  void velocity() {
    std::vector<float> v;
    nodes([&](int r, int i) {
      for (std::size_t d = 0; d < 3; ++d) {
        v.push_back(d < Dim ? static_cast<float>(b_.velocity[d].row(r)[i]) : 0.0F);
      }
    });
    d_.point_arrays.push_back({"velocity", 3, std::move(v)});
  }
  void points() {
    nodes([&](int r, int i) {
      for (std::size_t d = 0; d < 3; ++d) {
        d_.points.push_back(d < Dim ? b_.position[d].row(r)[i] : 0.0);
      }
    });
  }
  double speed(int j, int k, int i) const {
    const bool sliding = mostly_slides(b_, b_.grid.cell_row(j, k), i);
    double sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      double u = 0;
      for (int corner = 0; corner < (1 << Dim); ++corner) {
        u += velocity_of(b_, sliding, d, b_.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)), i + (corner & 1));
      }
      sum += u * u / (1 << (2 * Dim));
    }
    return std::sqrt(sum);
  }

private:
  template <class Visit> void nodes(Visit&& visit) {
    const Grid& g = b_.grid;
    for (int k = 0; k < (Dim == 3 ? g.cells[2] + 1 : 1); ++k) {
      for (int j = 0; j <= g.cells[1]; ++j) {
        for (int i = 0; i <= g.cells[0]; ++i) {
          visit(g.node_row(j, k), i);
        }
      }
    }
  }
  const Block<Dim>& b_;
  io::GridDump& d_;
  std::size_t cells_;
};

/// -1: void, or mixed with void where polygons cover the rest.
template <int Dim> int drawn_material(const Block<Dim>& b, int layer, int r, int i) {
  const int owner = b.owner_row(r)[i], hole = b.void_index();
  if (owner >= 0) {
    return owner == hole ? -1 : owner;
  }
  if (hole >= 0 && in_section<Dim>(b.grid, r, layer) && b.materials.back().store.row(field::fraction, r)[i] > 0) {
    return -1;
  }
  int best = -1;
  double most = 0;
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    const double f = b.materials[m].store.row(field::fraction, r)[i];
    if (f > most) {
      most = f;
      best = static_cast<int>(m) == hole ? -1 : static_cast<int>(m);
    }
  }
  return best;
}

/// Coordinates at whose 0 the block is mirrored: where a side symmetric in one lies there.
std::vector<std::string> symmetry_of(const Block<3>& b) {
  std::vector<std::string> axes;
  for (int component = 0; component < 3; ++component) {
    bool mirrored = false;
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < (b.map.curved() ? 2 : 1); ++side) {
        std::array<int, 3> end = {0, 0, 0};
        end[static_cast<std::size_t>(axis)] = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(axis)];
        const double at = b.position[static_cast<std::size_t>(component)].row(b.grid.node_row(end[1], end[2]))[end[0]];
        mirrored = mirrored || (b.boundary.normal_of(axis, side) == component && b.boundary.at(axis, side).kind == BoundaryKind::symmetry && at == 0);
      }
    }
    if (mirrored) {
      axes.push_back(std::string(1, "xyz"[component]));
    }
  }
  return axes;
}

} // namespace

template <int Dim>
io::GridDump dump_block(const Block<Dim>& b, remap::NormalMethod normal, const std::vector<std::string>& fields) {
  io::GridDump dump;
  dump.block = b.name;
  dump.geometry = Dim == 3 ? "3d" : b.axisymmetric ? "axisymmetric" : "planar";
  if constexpr (Dim == 3) {
    dump.symmetry = symmetry_of(b);
  }
  dump.cells = {b.grid.cells[0], b.grid.cells[1], Dim == 3 ? b.grid.cells[2] : 0};
  Dumper<Dim> out(b, dump);
  out.points();
  for (const MaterialSlot& slot : b.materials) {
    if (!slot.is_void) {
      dump.material_names.push_back(slot.material.name);
    }
  }
  dump.section_layer = section_layer(b);
  out.cells("material", [&](int r, int i) { return drawn_material(b, dump.section_layer, r, i); });
  out.cells("pressure", [&](int r, int i) {
    return b.owner_row(r)[i] == b.void_index() && b.void_index() >= 0 ? 0.0 : b.pressure.row(r)[i] + b.reference_pressure;
  });
  {
    std::vector<float> v;
    for_each_cell(b, [&](int i, int j, int k) { v.push_back(static_cast<float>(out.speed(j, k, i))); });
    dump.cell_arrays.push_back({"speed", 1, std::move(v)});
  }
  const auto wanted = [&](const char* name) { return std::find(fields.begin(), fields.end(), name) != fields.end(); };
  if (wanted("velocity")) {
    out.velocity();
  }
  if (wanted("density")) {
    out.cells("density", [&](int r, int i) { return b.density.row(r)[i]; });
  }
  if (wanted("sound_speed")) {
    out.cells("sound_speed", [&](int r, int i) { return b.wave_speed.row(r)[i]; });
  }
  if (wanted("volume_fraction")) {
    for (const MaterialSlot& slot : b.materials) {
      out.cells("volume_fraction_" + slot.material.name, [&](int r, int i) { return slot.store.row(field::fraction, r)[i]; });
    }
  }
  if (wanted("specific_energy")) {
    out.cells("specific_energy", [&](int r, int i) {
      double mass = 0, e = 0;
      for (const MaterialSlot& slot : b.materials) {
        if (!slot.is_void) {
          mass += slot.store.row(field::mass, r)[i];
          e += slot.store.row(field::mass, r)[i] * slot.store.row(field::energy, r)[i];
        }
      }
      return mass > 0 ? e / mass : 0.0;
    });
  }
  if (wanted("plastic_strain")) {
    out.cells("plastic_strain", [&](int r, int i) {
      double sum = 0;
      for (const MaterialSlot& slot : b.materials) {
        sum += slot.strength ? slot.store.row(field::fraction, r)[i] * slot.store.row(field::plastic_strain<Dim>, r)[i] : 0.0;
      }
      return sum;
    });
  }
  if (wanted("damage")) {
    out.cells("damage", [&](int r, int i) {
      double sum = 0;
      for (const MaterialSlot& slot : b.materials) {
        sum += slot.damages ? slot.store.row(field::fraction, r)[i] * slot.store.row(field::damage<Dim>, r)[i] : 0.0;
      }
      return sum;
    });
  }
  if (wanted("deviatoric_stress") && b.any_strength()) {
    out.cells("equivalent_stress", [&](int r, int i) {
      const double xx = b.stress[0].row(r)[i], yy = b.stress[1].row(r)[i];
      double shear = 0;
      for (std::size_t a = 2; a < b.stress.size(); ++a) {
        shear += b.stress[a].row(r)[i] * b.stress[a].row(r)[i];
      }
      return std::sqrt(1.5 * (xx * xx + yy * yy + (xx + yy) * (xx + yy) + 2 * shear));
    });
  }
  if (wanted("viscosity")) {
    out.cells("viscosity", [&](int r, int i) {
      double q = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        q = std::max(q, b.viscosity[d].row(r)[i]);
      }
      return q;
    });
  }
  dump.material_polygons = section_polygons(b, normal);
  return dump;
}

template io::GridDump dump_block<2>(const Block<2>&, remap::NormalMethod, const std::vector<std::string>&);
template io::GridDump dump_block<3>(const Block<3>&, remap::NormalMethod, const std::vector<std::string>&);

} // namespace ballast
