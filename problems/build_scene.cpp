#include "problems/build_scene.hpp"

#include "ale/embedding.hpp"
#include "ale/fill.hpp"
#include "core/error.hpp"
#include "problems/build_layers.hpp"

#include <algorithm>
#include <utility>
#include <cmath>

namespace ballast {

SlotMap slot_map(const SceneSpec& spec) {
  SlotMap map;
  map.slot.assign(spec.materials.size(), -1);
  int next = 0;
  for (const int m : spec.interface_order) {
    map.slot[static_cast<std::size_t>(m)] = next++;
  }
  for (int& s : map.slot) {
    s = s < 0 ? next++ : s;
  }
  return map;
}

namespace {

Numerics method_of(const SceneSpec& spec) {
  Numerics n = spec.numerics;
  const bool strength = std::any_of(spec.materials.begin(), spec.materials.end(),
                                    [](const Material& mat) { return has_strength(mat.strength); });
  n.energy_return = spec.energy_return == Switch::on || (spec.energy_return == Switch::automatic && !strength);
  return n;
}

bool needs_void(const SceneSpec& spec) {
  const bool spall = spec.numerics.spall && std::any_of(spec.materials.begin(), spec.materials.end(), [](const Material& m) {
                       return std::isfinite(m.spall_pressure) || m.failure.has_value();
                     });
  const bool holes = std::any_of(spec.bodies.begin(), spec.bodies.end(), [](const Body& b) { return b.material < 0; });
  bool free = false; // behind a free side of an eulerian mesh there is void, and it may flow in
  for (std::size_t axis = 0; axis < spec.boundaries.size() && !spec.mesh_lines[axis].empty(); ++axis) {
    for (const Boundary& side : spec.boundaries[axis]) {
      free = free || (side.kind == BoundaryKind::free && spec.motion.remaps());
    }
  }
  const bool layers = !spec.layers.empty() && embeds_layers(spec.motion); // what they cover
  return spec.background < 0 || spall || holes || free || layers;
}

/// Momentum by node while cells are filled; velocities are its mean by mass.
template <int Dim> struct NodeMomentum {
  std::array<RowField, Dim> momentum;
  RowField mass;
};

template <int Dim>
void add_momentum(const Block<Dim>& b, int i, int j, int k, double mass, const Body* body, NodeMomentum<Dim>& sum) {
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const double share = mass * corner_share(b, corner, i, j, k);
    const int r = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)), n = i + (corner & 1);
    sum.mass.row(r)[n] += share;
    Point velocity = body != nullptr ? body->velocity : Point{};
    if (body != nullptr && body->radial) {
      Point x{};
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d] = b.position[d].row(r)[n];
      }
      velocity = body->velocity_at(x);
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      sum.momentum[d].row(r)[n] += share * velocity[d];
    }
  }
}

/// What the cell lo..hi (logical coordinates) holds at the start, by material slot; `each`(material, fraction, density, body) hears of
/// every part, of the background's without a body.
template <class Each>
void initial_parts(const SceneSpec& spec, const SlotMap& slots, const Point& lo, const Point& hi, std::vector<double>& shares, std::vector<CellPart>& parts, Each&& each) {
  body_fractions(spec, lo, hi, shares);
  double left = 1;
  const auto add = [&](int material, double f, double density, double e, const Body* body) {
    CellPart& p = parts[static_cast<std::size_t>(material < 0 ? static_cast<int>(parts.size()) - 1 : slots.slot[static_cast<std::size_t>(material)])];
    const double mass = p.fraction * p.density + f * density;
    p.specific_energy = mass > 0 ? (p.fraction * p.density * p.specific_energy + f * density * e) / mass : 0;
    p.fraction += f;
    p.density = p.fraction > 0 ? mass / p.fraction : 0;
    if (f == p.fraction) { // the only body of its material here: bitwise its own state
      p.density = density;
      p.specific_energy = e;
    }
    each(material, f, density, body);
    left -= f;
  };
  for (std::size_t q = 0; q < spec.bodies.size(); ++q) {
    if (shares[q] > 0) {
      const Body& body = spec.bodies[q];
      add(body.material, shares[q], body.density, body.specific_energy, &body);
    }
  }
  if (left > 1e-12) {
    if (spec.background < 0) {
      add(-1, left, 0, 0, nullptr);
    } else {
      const Material& m = spec.materials[static_cast<std::size_t>(spec.background)];
      add(spec.background, left, m.density, m.specific_energy, nullptr);
    }
  }
  for (std::size_t m = 0; m < parts.size(); ++m) {
    parts[m].material = static_cast<int>(m);
    parts[m].fraction = parts[m].fraction > 1 - 1e-12 ? 1.0 : parts[m].fraction;
  }
}

/// What a mesh that follows meets on its way: the initial state of what does not move.
template <int Dim> void set_outside(const SceneSpec& spec, const SlotMap& slots, Block<Dim>& b) {
  SceneSpec resting = spec;
  std::erase_if(resting.bodies, [](const Body& body) { return body.moves(); });
  b.outside = [resting = std::move(resting), slots, count = b.materials.size()](const Point& lo, const Point& hi, std::vector<remap::Outside>& out) {
    std::vector<double> shares(resting.bodies.size());
    std::vector<CellPart> parts(count);
    initial_parts(resting, slots, lo, hi, shares, parts, [](int, double, double, const Body*) {});
    for (const CellPart& p : parts) {
      if (p.fraction > 0) {
        out.push_back({p.material, p.fraction, p.density, p.specific_energy});
      }
    }
  };
}

template <int Dim>
void fill_block(const SceneSpec& spec, const SlotMap& slots, Block<Dim>& b) {
  constexpr double trace = 1e-9; // of a node's mass: the rounding of the bodies' shares does not slide
  NodeMomentum<Dim> nodes, sliding;
  nodes.mass = sliding.mass = RowField::of_nodes(b.grid);
  nodes.momentum.fill(nodes.mass);
  sliding.momentum.fill(nodes.mass);
  std::vector<double> shares(spec.bodies.size());
  for_each_cell(b, [&](int i, int j, int k) {
    Point lo{}, hi{};
    const int index[3] = {i, j, k};
    for (int d = 0; d < Dim; ++d) {
      const auto& line = spec.mesh_lines[static_cast<std::size_t>(d)];
      lo[static_cast<std::size_t>(d)] = line[static_cast<std::size_t>(index[d])];
      hi[static_cast<std::size_t>(d)] = line[static_cast<std::size_t>(index[d] + 1)];
    }
    const double volume = b.volume.row(b.grid.cell_row(j, k))[i];
    std::vector<CellPart> parts(b.materials.size());
    initial_parts(spec, slots, lo, hi, shares, parts, [&](int material, double f, double density, const Body* body) {
      if (material >= 0) {
        const bool slides = b.materials[static_cast<std::size_t>(slots.slot[static_cast<std::size_t>(material)])].slides;
        add_momentum(b, i, j, k, f * density * volume, body, slides ? sliding : nodes);
      }
    });
    fill_cell<Dim>(b, i, j, k, parts);
  });
  for (std::size_t q = 0; q < nodes.mass.data().size(); ++q) {
    const double m = nodes.mass.data()[q], ms = sliding.mass.data()[q];
    for (std::size_t d = 0; d < Dim; ++d) {
      const double p = nodes.momentum[d].data()[q], ps = sliding.momentum[d].data()[q];
      const double v = m > 0 ? p / m : 0.0, u = ms > 0 ? ps / ms : v;
      b.velocity[d].data()[q] = m > 0 ? v + remap::node_follows(ms, m + ms) * (u - v) : u;
      if (std::min(m, ms) > trace * (m + ms)) {
        b.sliding.jump[d].data()[q] = u - v;
      }
    }
  }
}

/// Normal velocities that boundaries prescribe hold from the start, for what slides too.
template <int Dim> void apply_boundary_velocity(Block<Dim>& b) {
  const Grid& g = b.grid;
  for (int k = 0; k < (Dim == 3 ? g.cells[2] + 1 : 1); ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      const int index[3] = {0, j, k};
      for (int axis = 0; axis < Dim; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const int r = g.node_row(j, k);
        const auto hold = [&](int side, int first, int last) {
          const auto d = static_cast<std::size_t>(b.boundary.normal_of(axis, side));
          std::fill(b.velocity[d].row(r) + first, b.velocity[d].row(r) + last + 1, b.boundary.at(axis, side).velocity);
          if (!b.sliding.jump[d].data().empty()) {
            std::fill(b.sliding.jump[d].row(r) + first, b.sliding.jump[d].row(r) + last + 1, 0.0);
          }
        };
        for (int side = 0; side < 2; ++side) {
          if (!b.boundary.fixes_normal_velocity(axis, side)) {
            continue;
          }
          const int last = g.cells[a];
          if (axis == 0) {
            hold(side, side == 0 ? 0 : last, side == 0 ? 0 : last);
          } else if (index[axis] == (side == 0 ? 0 : last)) {
            hold(side, 0, g.cells[0]);
          }
        }
      }
    }
  }
}

template <int Dim> bool starts_with_void(const Block<Dim>& b) {
  constexpr double some = 1e-6; // of a cell; less is the rounding of the bodies' shares
  bool any = false;
  for_each_cell(b, [&](int i, int j, int k) {
    const int hole = b.void_index();
    any = any || (hole >= 0 && std::as_const(b.materials[static_cast<std::size_t>(hole)].store).row(field::fraction, b.grid.cell_row(j, k))[i] > some);
  });
  return any;
}

/// Bodies in a void have a vacuum around them, not the ambient atmosphere: forces are then taken against zero
/// pressure, inside and beyond a free side alike. Against the ambient pressure a free side would push it
/// through void cells on to nodes that hold next to no mass.
template <int Dim> void release_to_vacuum(Block<Dim>& b) {
  b.reference_pressure = 0;
  for (MaterialSlot& slot : b.materials) {
    if (!slot.is_void) {
      slot.reference = make_slot(slot.material, 0).reference;
    }
  }
}

} // namespace

template <int Dim> Scene<Dim> build_scene(const SceneSpec& spec, int threads) {
  for (const auto& axis : spec.boundaries) {
    for (const Boundary& side : axis) {
      if (side.kind == BoundaryKind::wall && side.wall_velocity != 0 && !sides_go_along(spec.motion)) {
        throw Error("mesh: a moving wall needs sides that go along: motion.policy = \"lagrangian\", or \"relax\" with its boundary lagrangian");
      }
    }
  }
  Scene<Dim> scene;
  scene.title = spec.title;
  scene.numerics = method_of(spec);
  scene.pool = std::make_unique<ThreadPool>(threads);
  const SlotMap slots = slot_map(spec);
  Block<Dim> b;
  b.axisymmetric = spec.geometry == Geometry::axisymmetric;
  b.map = spec.map;
  b.motion = spec.motion;
  for (int& leader : b.motion.leaders) {
    leader = slots.slot[static_cast<std::size_t>(leader)];
  }
  b.reference_pressure = spec.ambient_pressure;
  b.materials.resize(spec.materials.size());
  for (std::size_t m = 0; m < spec.materials.size(); ++m) {
    b.materials[static_cast<std::size_t>(slots.slot[m])] = make_slot(spec.materials[m], spec.ambient_pressure);
  }
  for (const int m : spec.sliding) {
    b.materials[static_cast<std::size_t>(slots.slot[static_cast<std::size_t>(m)])].slides = true;
  }
  if (needs_void(spec)) {
    b.materials.push_back(make_void());
  }
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Boundary& from = spec.boundaries[axis][side];
      b.boundary.side[axis][side] = {from.kind, from.wall_velocity};
      if (from.kind == BoundaryKind::inflow) {
        const int slot = slots.slot[static_cast<std::size_t>(from.material)];
        b.boundary.side[axis][side] = inflow_side(static_cast<int>(axis), {slot, from.density, from.specific_energy, from.velocity});
      }
    }
  }
  allocate_block(b, spec.mesh_lines);
  fill_block(spec, slots, b);
  if (spec.motion.policy == MotionPolicy::follow) {
    set_outside(spec, slots, b);
  }
  if (starts_with_void(b)) {
    if (!spec.layers.empty() && !embeds_layers(spec.motion)) {
      throw Error("layers: only the free sides of the mesh touch them, and it begins with void: a mesh of exactly what strikes them");
    }
    release_to_vacuum(b);
  }
  apply_boundary_velocity(b);
  scene.blocks.push_back(std::move(b));
  for (const LayersSpec& layers : spec.layers) {
    scene.layers.push_back(build_layers<Dim>(layers, spec.geometry));
    if (layers.debris >= 0) {
      Layers<Dim>& l = scene.layers.back();
      l.debris = slots.slot[static_cast<std::size_t>(layers.debris)];
      l.whole_mass = l.stack.mass;
    }
  }
  if (!spec.layers.empty() && embeds_layers(spec.motion)) {
    scene.embedded.push_back(std::make_shared<Embedding<Dim>>());
  }
  prepare(scene);
  return scene;
}

template Scene<2> build_scene<2>(const SceneSpec&, int);
template Scene<3> build_scene<3>(const SceneSpec&, int);

} // namespace ballast
