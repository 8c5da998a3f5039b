// Slivers and their roots: one state for both, and what the cells then hold.
#include "ale/embedding_pass.hpp"

namespace ballast {

namespace {

constexpr double nothing = 1e-12;    ///< of a cell at reference density: a material's trace that is dropped, with an entry
constexpr double alone = 5e-11;      ///< likewise: a trace in a void, with no such neighbour, that is dropped
constexpr double merged_below = 0.25; ///< of a whole cell: smaller slivers hold the same mixture as their root, void and all
constexpr double largest_stretch = 0.98; ///< of a cell's room: less than that is a void

} // namespace

template <int Dim> void EmbeddedRemap<Dim>::pool() {
  path_[0] = &b_.position;
  levels_[0] = std::move(e_.next);
  find_cells<Dim>(b_, *path_[0], levels_[0], *scene_.pool, lag_.kind, lag_.cut);
  target_ = lag_;
  find_special();
  gather();
  for (std::size_t c = 0; c < cells_.size(); ++c) { // as they are, but for what has no room
    to_volume_[c] = lag_.kind[dense(cells_[c])] == covered_cell ? 0.0 : from_volume_[c];
  }
  hand_on_wisps();
  relieve();
  find_roots(target_, to_volume_, next_root_);
  bury();
  equalise();
  scatter();
  move_momentum();
  e_.now = std::move(levels_[0]);
}

template <int Dim> void EmbeddedRemap<Dim>::pool_contents(const std::vector<int>& root, Contents& pool, std::vector<char>& pooled) const {
  pool.assign(cells_.size(), size_);
  pooled.assign(cells_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto q = static_cast<std::size_t>(root[c]);
    const std::span<double> all = pool[q];
    const std::span<const double> own = contents_[c];
    for (std::size_t n = 0; n < own.size(); ++n) {
      all[n] += own[n];
    }
    pooled[q] = q != c ? 1 : pooled[q];
  }
}

template <int Dim> void EmbeddedRemap<Dim>::settle() {
  Contents pool;
  std::vector<char> pooled;
  pool_contents(root_, pool, pooled);
  std::vector<std::array<double, 2>> before(cells_.size());
  std::vector<double> volume(cells_.size());
  std::vector<char> stirred(cells_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    before[c] = masses_of(c);
    stirred[static_cast<std::size_t>(root_[c])] |= touched_[c];
  }
  for (int m = 0; m < materials(); ++m) {
    std::fill(volume.begin(), volume.end(), 0.0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      volume[static_cast<std::size_t>(root_[c])] += std::max(at(c, m, 0), 0.0);
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto root = static_cast<std::size_t>(root_[c]);
      if ((root == c && pooled[c] == 0) || !stirred[root]) {
        continue;
      }
      const double share = volume[root] > 0 ? std::max(at(c, m, 0), 0.0) / volume[root] : (c == root ? 1.0 : 0.0);
      for (int f = 0; f < fields(m); ++f) {
        at(c, m, f) = share * pool[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)] + f)];
      }
    }
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (root_[c] != static_cast<int>(c)) {
      transfer_change(c, static_cast<std::size_t>(root_[c]), before[c]);
    }
  }
}

template <int Dim> void EmbeddedRemap<Dim>::keep_pools() {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (next_root_[c] == static_cast<int>(c) && root_[c] != static_cast<int>(c)) {
      const int to = next_root_[static_cast<std::size_t>(root_[c])];
      next_root_[c] = to;
    }
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    next_root_[c] = next_root_[static_cast<std::size_t>(next_root_[c])];
  }
}

template <int Dim> void EmbeddedRemap<Dim>::bury() {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (special_[dense(cells_[c])] == 0 || to_volume_[c] > 0) {
      continue;
    }
    const double mass = mass_of(c);
    const std::size_t root = next_root_[c] != static_cast<int>(c) || !(mass > 0) ? static_cast<std::size_t>(next_root_[c]) : way_out(c);
    if (root == c) {
      to_volume_[c] = mass > 0 ? from_volume_[c] : 0.0;
      continue;
    }
    const std::array<double, 2> before = masses_of(c);
    const std::span<double> from = contents_[c], into = contents_[root];
    for (std::size_t n = 0; n < from.size(); ++n) {
      into[n] += from[n];
      from[n] = 0;
    }
    if (mass != 0) {
      transfer_change(c, root, before);
      touched_[root] = touched_[c] = 1;
    }
    next_root_[c] = static_cast<int>(c);
  }
}

template <int Dim> bool EmbeddedRemap<Dim>::at_rest(const std::vector<std::size_t>& members) const {
  constexpr double rounding = 1e-12;
  for (const std::size_t c : members) {
    if (touched_[c] != 0 || room(c) != from_volume_[c]) {
      return false;
    }
  }
  for (int m = 0; m < materials(); ++m) {
    for (int f = 1; f < fields(m); ++f) { // density, then what a kilogram holds
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const std::size_t c : members) {
        const double whole = at(c, m, f == 1 ? 0 : 1);
        if (whole > 0) {
          least = std::min(least, at(c, m, f) / whole);
          most = std::max(most, at(c, m, f) / whole);
        }
      }
      if (most > least && most - least > rounding * std::max(std::abs(most), std::abs(least))) {
        return false;
      }
    }
  }
  return true;
}

template <int Dim> void EmbeddedRemap<Dim>::give_room(std::size_t root, const std::vector<std::size_t>& members) {
  const double keeps = 1 - e_.squeeze;
  double room_there = 0, filled = 0;
  for (const std::size_t c : members) {
    room_there += room(c);
    for (int m = 0; m < materials(); ++m) {
      filled += is_void(m) ? 0.0 : at(c, m, 0);
    }
  }
  if (special_[dense(cells_[root])] != 0 && keeps * filled > room_there) {
    to_volume_[root] += keeps * filled - room_there;
  }
}

template <int Dim> void EmbeddedRemap<Dim>::equalise() {
  Contents pool;
  std::vector<char> pooled;
  pool_contents(next_root_, pool, pooled);
  std::vector<std::vector<std::size_t>> members_of(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    members_of[static_cast<std::size_t>(next_root_[c])].push_back(c);
  }
  for (std::size_t root = 0; root < cells_.size(); ++root) {
    const std::vector<std::size_t>& members = members_of[root];
    if (pooled[root] == 0) {
      if (next_root_[root] == static_cast<int>(root)) {
        give_room(root, members);
      }
      continue;
    }
    bool valid = true;
    for (const std::size_t c : members) {
      double sum = 0;
      for (int m = 0; m < materials(); ++m) {
        valid = valid && at(c, m, 0) >= 0;
        sum += at(c, m, 0);
      }
      valid = valid && std::abs(sum - room(c)) <= 0.05 * room(c);
      valid = valid && (c == root || room(c) > merged_below * whole_of(target_, cells_[c]));
    }
    give_room(root, members);
    if (at_rest(members)) {
      continue;
    }
    // The materials' volumes in the pool, void what is left of its room: more room than they fill is not theirs.
    double held = 0, rooms = 0;
    for (int m = 0; m < materials(); ++m) {
      held += is_void(m) ? 0.0 : std::max(pool[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0);
    }
    for (const std::size_t c : members) {
      rooms += room(c);
    }
    const double gap = pool[root][static_cast<std::size_t>(offset_.back())];
    const bool full = held > rooms || (!(gap > 1e-9 * rooms) && held > largest_stretch * rooms);
    const double scale = full ? rooms / held : 1.0, hollow = full ? 0.0 : rooms - held;
    std::vector<std::array<double, 2>> before;
    for (const std::size_t c : members) {
      before.push_back(masses_of(c));
      if (!valid) {
        for (int m = 0; m < materials(); ++m) {
          const double v = is_void(m) ? hollow : scale * std::max(pool[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0);
          at(c, m, 0) = rooms > 0 ? v / rooms * room(c) : 0.0;
        }
      }
    }
    for (int m = 0; m < materials(); ++m) {
      if (is_void(m)) {
        continue;
      }
      double volume = 0;
      for (const std::size_t c : members) {
        volume += fitted(c, m);
      }
      for (const std::size_t c : members) {
        const double share = volume > 0 ? fitted(c, m) / volume : (c == root ? 1.0 : 0.0);
        for (int f = 1; f < fields(m); ++f) {
          at(c, m, f) = share * pool[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)] + f)];
        }
      }
    }
    std::size_t q = 0;
    for (const std::size_t c : members) {
      if (c != root) {
        transfer_change(c, root, before[q]);
      }
      ++q;
    }
  }
}

template <int Dim> double EmbeddedRemap<Dim>::fitted(std::size_t c, int m) const {
  double sum = 0;
  for (int q = 0; q < materials(); ++q) {
    sum += is_void(q) ? 0.0 : std::max(at(c, q, 0), 0.0);
  }
  const double v = std::max(at(c, m, 0), 0.0);
  const auto root = static_cast<std::size_t>(next_root_[c]);
  const auto hollow = [&](std::size_t q) { return at(q, materials() - 1, 0) > 1e-9 * room(q); };
  // Room that geometry has left over is filled; of a sliver all of it if what is behind it is solid.
  const bool fills = !hollow(c) && !hollow(root) && sum > (root == c ? largest_stretch : 0.0) * room(c);
  return sum > room(c) || fills ? v * room(c) / sum : v;
}

template <int Dim> void EmbeddedRemap<Dim>::scatter() {
  e_.pockets.clear();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (std::ranges::equal(std::as_const(contents_)[c], std::as_const(start_)[c]) && room(c) == from_volume_[c]) {
      keep_room(c);
      continue;
    }
    const std::array<int, 3>& cell = cells_[c];
    const int r = g_.cell_row(cell[1], cell[2]), i = cell[0];
    const double volume = room(c);
    double left = 1;
    const bool covered = special_[dense(cell)] != 0 && !(volume > 0);
    for (int m = 0; m < materials(); ++m) {
      MaterialSlot& slot = b_.materials[static_cast<std::size_t>(m)];
      if (slot.is_void) {
        continue;
      }
      const double v = covered ? 0.0 : fitted(c, m), mass = at(c, m, 1);
      const bool hollow = at(c, materials() - 1, 0) > 0.9 * volume;
      const bool some = v > 0 && mass > (hollow ? alone : nothing) * slot.material.density * volume;
      if (!some && mass != 0) {
        scene_.ledger.sliver_mass += mass;
        scene_.ledger.sliver_energy += at(c, m, 2);
        ++scene_.ledger.slivers;
      }
      if (!some && !slot.store.has_row(r)) {
        continue;
      }
      slot.store.allocate(slot.store.tile_of(r));
      slot.store.row(field::fraction, r)[i] = some ? v / volume : 0.0;
      slot.store.row(field::mass, r)[i] = some ? mass : 0.0;
      for (int f = 2; f < slot.store.conserved(); ++f) {
        slot.store.row(f, r)[i] = some ? at(c, m, f) / mass : 0.0;
      }
      left -= some ? v / volume : 0.0;
    }
    TileStore& gap = b_.materials.back().store;
    gap.allocate(gap.tile_of(r));
    gap.row(field::fraction, r)[i] = left > 1e-13 ? left : 0.0;
    b_.volume.row(r)[i] = covered ? whole_of(target_, cell) : volume;
    if (!covered) {
      keep_room(c);
    }
    settle_round_off(r, i);
    compute_owner(b_, r, {i, i + 1});
  }
}

template <int Dim> void EmbeddedRemap<Dim>::settle_round_off(int r, int i) {
  double sum = 0, most = 0;
  MaterialSlot* largest = nullptr;
  for (MaterialSlot& slot : b_.materials) {
    const double f = std::as_const(slot.store).row(field::fraction, r)[i];
    sum += f;
    if (f > most) {
      most = f;
      largest = &slot;
    }
  }
  if (largest != nullptr) {
    largest->store.row(field::fraction, r)[i] += 1 - sum;
  }
}

template void EmbeddedRemap<2>::pool();
template void EmbeddedRemap<3>::pool();
template void EmbeddedRemap<2>::pool_contents(const std::vector<int>& root, Contents& pool, std::vector<char>& pooled) const;
template void EmbeddedRemap<3>::pool_contents(const std::vector<int>& root, Contents& pool, std::vector<char>& pooled) const;
template void EmbeddedRemap<2>::settle();
template void EmbeddedRemap<3>::settle();
template void EmbeddedRemap<2>::keep_pools();
template void EmbeddedRemap<3>::keep_pools();
template void EmbeddedRemap<2>::bury();
template void EmbeddedRemap<3>::bury();
template bool EmbeddedRemap<2>::at_rest(const std::vector<std::size_t>& members) const;
template bool EmbeddedRemap<3>::at_rest(const std::vector<std::size_t>& members) const;
template void EmbeddedRemap<2>::give_room(std::size_t root, const std::vector<std::size_t>& members);
template void EmbeddedRemap<3>::give_room(std::size_t root, const std::vector<std::size_t>& members);
template void EmbeddedRemap<2>::equalise();
template void EmbeddedRemap<3>::equalise();
template double EmbeddedRemap<2>::fitted(std::size_t c, int m) const;
template double EmbeddedRemap<3>::fitted(std::size_t c, int m) const;
template void EmbeddedRemap<2>::scatter();
template void EmbeddedRemap<3>::scatter();
template void EmbeddedRemap<2>::settle_round_off(int r, int i);
template void EmbeddedRemap<3>::settle_round_off(int r, int i);

} // namespace ballast
