// Traces beside bodies: what is next to nothing in its cell, and what a body has buried.
#include "ale/embedding_cells.hpp"
#include "ale/embedding_motion.hpp"
#include "ale/embedding_pass.hpp"

namespace ballast {

namespace {

constexpr double wisp = 1e-6;        ///< of a cell at reference density: what goes on to a neighbour that has more of it

} // namespace

template <int Dim> std::size_t EmbeddedRemap<Dim>::way_out(std::size_t c) const {
  constexpr int farthest = 2; // cells
  int main = 0; // what there is most of
  for (int m = 1; m < materials(); ++m) {
    main = !is_void(m) && at(c, m, 1) > at(c, main, 1) ? m : main;
  }
  std::size_t best = c;
  int least = std::numeric_limits<int>::max();
  double most = 0;
  for (int k = Dim == 3 ? -farthest : 0; k <= (Dim == 3 ? farthest : 0); ++k) {
    for (int j = -farthest; j <= farthest; ++j) {
      for (int i = -farthest; i <= farthest; ++i) {
        const std::array<int, 3> n = {cells_[c][0] + i, cells_[c][1] + j, cells_[c][2] + k};
        if (!inside(n) || place_[dense(n)] < 0) {
          continue;
        }
        const auto q = static_cast<std::size_t>(place_[dense(n)]);
        if (side_[c] >= 0 && side_[q] >= 0 && side_[q] != side_[c]) {
          continue;
        }
        const double mass = at(q, main, 1);
        const int square = i * i + j * j + k * k;
        if (room(q) > 0 && mass > at(c, main, 1) && (square < least || (square == least && mass > most))) {
          best = static_cast<std::size_t>(next_root_[q]);
          least = square;
          most = mass;
        }
      }
    }
  }
  return best;
}

template <int Dim> void EmbeddedRemap<Dim>::relieve() {
  constexpr double spare = 0.05, most_of_void = 0.9; // of a whole cell; of a neighbour's void
  const int last = materials() - 1;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (special_[dense(cells_[c])] == 0 || !(to_volume_[c] > 0)) {
      continue;
    }
    double held = 0;
    for (int m = 0; m < last; ++m) {
      held += std::max(at(c, m, 0), 0.0);
    }
    const double excess = held - open_of(target_, cells_[c]);
    if (!(excess > spare * whole_of(target_, cells_[c]))) {
      continue;
    }
    double widest = 0;
    std::size_t to = c;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> cell = cells_[c];
        cell[axis] += side;
        if (!inside(cell) || place_[dense(cell)] < 0 || !(own_aperture(levels_[target_.at], c, axis, side < 0 ? cells_[c] : cell) > 0)) {
          continue;
        }
        const auto q = static_cast<std::size_t>(place_[dense(cell)]);
        const bool apart = side_[c] >= 0 && side_[q] >= 0 && side_[q] != side_[c];
        const double room_there = room(q) > 0 && !apart ? at(q, last, 0) : 0.0;
        if (room_there > widest) {
          widest = room_there;
          to = q;
        }
      }
    }
    if (to == c) {
      continue;
    }
    const double volume = std::min(excess, most_of_void * at(to, last, 0)), share = volume / held;
    const std::array<double, 2> before = masses_of(c);
    for (int m = 0; m < last; ++m) {
      for (int f = 0; f < fields(m); ++f) {
        const double amount = share * at(c, m, f);
        at(c, m, f) -= amount;
        at(to, m, f) += amount;
      }
    }
    at(to, last, 0) -= volume;
    to_volume_[c] = std::max(to_volume_[c] - volume, open_of(target_, cells_[c]));
    transfer_change(c, to, before);
    touched_[c] = touched_[to] = 1;
  }
}

template <int Dim> void EmbeddedRemap<Dim>::hand_on_wisps() {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    for (int m = 0; m < materials(); ++m) {
      const double mass = is_void(m) ? 0.0 : at(c, m, 1);
      if (!(mass > 0) || !(room(c) > 0) || mass >= wisp * b_.materials[static_cast<std::size_t>(m)].material.density * room(c)) {
        continue;
      }
      double most = 10 * mass;
      auto to = c;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        for (const int side : {-1, 1}) {
          std::array<int, 3> n = cells_[c];
          n[axis] += side;
          if (!inside(n) || place_[dense(n)] < 0 || !(aperture(target_, axis, side < 0 ? cells_[c] : n) > 0)) {
            continue;
          }
          const auto q = static_cast<std::size_t>(place_[dense(n)]);
          if (at(q, m, 1) > most && room(q) > 0) {
            most = at(q, m, 1);
            to = q;
          }
        }
      }
      if (to == c) { // alone in a void: a drop at rest, else it would boil away without end
        const double drop = mass / b_.materials[static_cast<std::size_t>(m)].material.density;
        if (at(c, materials() - 1, 0) > 0.9 * room(c) && std::abs(at(c, m, 0) - drop) > 0.1 * drop) {
          at(c, materials() - 1, 0) += at(c, m, 0) - drop;
          scene_.ledger.sliver_energy += at(c, m, field::energy);
          at(c, m, 0) = drop;
          at(c, m, field::energy) = 0;
        }
        continue;
      }
      at(c, materials() - 1, 0) += at(c, m, 0);
      at(to, materials() - 1, 0) = std::max(0.0, at(to, materials() - 1, 0) - at(c, m, 0));
      for (int f = 0; f < fields(m); ++f) {
        at(to, m, f) += at(c, m, f);
        at(c, m, f) = 0;
      }
      transfer(c, to, mass, group_of(m));
      touched_[c] = touched_[to] = 1;
    }
  }
}

namespace {

/// What is at a node stops, but for what a wall makes it do; its momentum and energy go to the ledger.
template <int Dim> void stop_node(Ledger& ledger, Block<Dim>& b, const std::array<int, 3>& node, int r, int i) {
  const double mass = b.node_mass.row(r)[i], slides = b.any_sliding() ? b.sliding.node_mass.row(r)[i] : 0.0;
  for (std::size_t d = 0; d < Dim; ++d) {
    if (held_along(b, node, d) != nullptr) {
      continue;
    }
    const double v = velocity_of(b, true, d, r, i), u = velocity_of(b, false, d, r, i);
    ledger.momentum_out[d] += slides * v + (mass - slides) * u;
    ledger.embedded_given += 0.5 * (slides * v * v + (mass - slides) * u * u);
    b.velocity[d].row(r)[i] = 0;
    if (b.any_sliding()) {
      b.sliding.jump[d].row(r)[i] = 0;
    }
  }
}

/// m2/s2, of the faster of the two that meet at a node; of what no wall makes it do.
template <int Dim> double fastest_square(const Block<Dim>& b, const std::array<int, 3>& node, int r, int i) {
  double square[2] = {0, 0};
  for (const bool slides : {false, true}) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double v = velocity_of(b, slides, d, r, i);
      square[slides ? 1 : 0] += held_along(b, node, d) != nullptr ? 0.0 : v * v;
    }
  }
  return std::max(square[0], square[1]);
}

} // namespace

template <int Dim> void join_wisps(Scene<Dim>& scene, const Embedding<Dim>& e, Block<Dim>& b) {
  constexpr double wisp = 1e-3, trace = 1e-9, flung = 1e-6; // of that neighbour's mass; of a cell of the lightest material
  constexpr double beyond = 3; // times the sound speed of the fastest material: no body flies so fast
  double lightest = std::numeric_limits<double>::infinity(), sound = 0; // kg/m3; m2/s2, of the fastest material at the start
  for (const MaterialSlot& slot : b.materials) {
    lightest = slot.is_void ? lightest : std::min(lightest, slot.material.density);
    sound = slot.is_void ? sound : std::max(sound, sound_speed_squared(slot.material.eos, slot.reference.rho, slot.reference.e));
  }
  const Grid& g = b.grid;
  for (const NodeFoot<Dim>& f : e.now.feet) {
    const std::array<int, 3> node = node_of<Dim>(g, f.row, f.index);
    const double mass = b.node_mass.row(f.row)[f.index];
    double most = 0;
    std::array<int, 3> heavy = node;
    for (int axis = 0; axis < Dim; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> to = node;
        to[static_cast<std::size_t>(axis)] += side;
        const int n = to[static_cast<std::size_t>(axis)];
        if (n < 0 || n > g.cells[static_cast<std::size_t>(axis)]) {
          continue;
        }
        const double m = b.node_mass.row(g.node_row(to[1], to[2]))[to[0]];
        if (m > most) {
          most = m;
          heavy = to;
        }
      }
    }
    if (!(mass > 0)) {
      continue;
    }
    const std::array<int, 3> at = {std::min(node[0], g.cells[0] - 1), std::min(node[1], g.cells[1] - 1), Dim == 3 ? std::min(node[2], g.cells[2] - 1) : 0};
    const double whole = lightest * b.target_volume.row(g.cell_row(at[1], at[2]))[at[0]];
    if (std::max(mass, most) < trace * whole) { // alone
      stop_node(scene.ledger, b, node, f.row, f.index);
      continue;
    }
    if (mass > wisp * most) {
      if (mass < flung * whole && fastest_square(b, node, f.row, f.index) > beyond * beyond * sound) {
        stop_node(scene.ledger, b, node, f.row, f.index);
      }
      continue;
    }
    const int r = g.node_row(heavy[1], heavy[2]), i = heavy[0];
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = b.velocity[d].row(f.row)[f.index], v = b.velocity[d].row(r)[i];
      if (held_along(b, node, d) != nullptr || held_along(b, heavy, d) != nullptr) {
        continue;
      }
      const double both = (mass * u + most * v) / (mass + most);
      scene.ledger.embedded_given -= shift_velocity(b, d, f.row, f.index, both - u) + shift_velocity(b, d, r, i, both - v);
    }
  }
}

template void join_wisps<2>(Scene<2>&, const Embedding<2>&, Block<2>&);
template void join_wisps<3>(Scene<3>&, const Embedding<3>&, Block<3>&);
template std::size_t EmbeddedRemap<2>::way_out(std::size_t c) const;
template std::size_t EmbeddedRemap<3>::way_out(std::size_t c) const;
template void EmbeddedRemap<2>::relieve();
template void EmbeddedRemap<3>::relieve();
template void EmbeddedRemap<2>::hand_on_wisps();
template void EmbeddedRemap<3>::hand_on_wisps();

} // namespace ballast
