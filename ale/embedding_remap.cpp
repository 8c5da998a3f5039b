// Remap beside bodies: what crosses the open parts of faces of cut cells, before the sweeps of all others.
//
// The bodies stand still; nodes go to their target one coordinate after the other as in remap/swept, and the open part of what each face
// sweeps (ale/embed/open_part) is what passes through it, so a plane body leaves volumes exact. Cells less than half open
// share one state with their root, the neighbour behind their widest opening: what leaves them is drawn from both, and at the end
// density and energy of every material are the same in both. What a body buries goes to the root whole. Momentum goes corner by
// corner with the mass, at the velocity of the corner it leaves.
#include "ale/embedding_cells.hpp"
#include "ale/embedding_pass.hpp"

#include "ale/phases.hpp"
#include "remap/internal.hpp"
#include "remap/reconstruct.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast {

template <int Dim> void EmbeddedRemap<Dim>::run() {
  find_levels_on_the_way();
  find_special();
  gather();
  find_roots(lag_, from_volume_, root_);
  move_through_faces();
  settle();
  keep_swept_rooms();
  hand_on_wisps();
  relieve();
  find_roots(target_, to_volume_, next_root_);
  keep_pools();
  bury();
  equalise();
  scatter();
  move_momentum();
  e_.now = std::move(levels_[Dim]); // where the sweeps leave the nodes
}

template <int Dim> void EmbeddedRemap<Dim>::find_levels_on_the_way() {
  find_least_thickness(scene_, e_); // the target may have moved
  const std::vector<LayerBody<Dim>> bodies = bodies_of(scene_, e_);
  path_[0] = &b_.position;
  levels_[0] = std::move(e_.next);
  for (int q = 0; q < Dim; ++q) {
    const auto next = static_cast<std::size_t>(q + 1), d = static_cast<std::size_t>(remap::sweep_axis(Dim, q, order_));
    if (next < Dim) {
      between_[next] = *path_[next - 1];
      between_[next][d] = b_.target[d];
    }
    path_[next] = next < Dim ? &between_[next] : &b_.target;
    levels_[next] = find_levels<Dim>(g_, *path_[next], bodies, *scene_.pool);
  }
  find_cells<Dim>(b_, *path_[0], levels_[0], *scene_.pool, lag_.kind, lag_.cut);
  find_cells<Dim>(b_, *path_[Dim], levels_[Dim], *scene_.pool, target_.kind, target_.cut);
  target_.at = Dim;
}

template <int Dim> void EmbeddedRemap<Dim>::find_special() {
  special_.assign(lag_.kind.size(), 0);
  place_.assign(lag_.kind.size(), -1);
  const Span rows = both_rows(e_.rows, both_rows(levels_[lag_.at].rows, levels_[target_.at].rows));
  for_cells_beside<Dim>(g_, rows, [&](int i, int j, int k) {
    const std::size_t c = dense({i, j, k});
    special_[c] = e_.kind[c] != open_cell || lag_.kind[c] != open_cell || target_.kind[c] != open_cell ? 1 : 0;
  });
  const auto take = [&](const std::array<int, 3>& c) {
    if (place_[dense(c)] < 0) {
      place_[dense(c)] = static_cast<int>(cells_.size());
      cells_.push_back(c);
    }
  };
  for (std::size_t a = 0; a < Dim && mesh_ != nullptr; ++a) { // faces of special cells: the sweeps leave them
    e_.closed[a].assign(special_.size(), 0);
  }
  for_cells_beside<Dim>(g_, rows, [&](int i, int j, int k) {
    const std::array<int, 3> c = {i, j, k};
    const std::size_t at_c = dense(c);
    if (special_[at_c] == 0) {
      return;
    }
    const bool empty = lag_.kind[at_c] == covered_cell && target_.kind[at_c] == covered_cell && !holds_anything(c);
    if (!empty) {
      take(c);
    }
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> n = c;
        n[axis] += side;
        if (mesh_ != nullptr) {
          e_.closed[axis][dense(n)] = 1;
        }
        n[axis] = c[axis] + (side == 0 ? -1 : 1);
        if (!empty && inside(n)) {
          take(n);
        }
      }
    }
  });
}

template <int Dim> bool EmbeddedRemap<Dim>::holds_anything(const std::array<int, 3>& c) const {
  for (const MaterialSlot& slot : b_.materials) {
    if (!slot.is_void && slot.store.row(field::mass, g_.cell_row(c[1], c[2]))[c[0]] > 0) {
      return true;
    }
  }
  return false;
}

template <int Dim> void EmbeddedRemap<Dim>::gather() {
  touched_.clear();
  contents_.assign(0, size_);
  for (const std::array<int, 3>& c : cells_) {
    touched_.push_back(0);
    const int r = g_.cell_row(c[1], c[2]), i = c[0];
    const bool special = special_[dense(c)] != 0;
    const double volume = b_.volume.row(r)[i];
    const bool covered = lag_.kind[dense(c)] == covered_cell;
    const std::span<double> now = contents_.add();
    bool holds = false;
    for (int m = 0; m < materials(); ++m) {
      const MaterialSlot& slot = b_.materials[static_cast<std::size_t>(m)];
      const auto first = static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)]);
      now[first] = slot.store.row(field::fraction, r)[i] * volume;
      if (!slot.is_void) {
        const double mass = slot.store.row(field::mass, r)[i];
        holds = holds || mass > 0;
        now[first + 1] = mass;
        for (int f = 2; f < slot.store.conserved(); ++f) {
          now[first + static_cast<std::size_t>(f)] = mass * slot.store.row(f, r)[i];
        }
      }
    }
    const int was = e_.kind[dense(c)];
    if (holds && was >= 0 && e_.cut[static_cast<std::size_t>(was)].scaled != 1) { // its own change of room is the pool's
      const double scaled = e_.cut[static_cast<std::size_t>(was)].scaled;
      double left = volume;
      for (int m = 0; m + 1 < materials(); ++m) {
        double& v = now[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])];
        v /= scaled;
        left -= v;
      }
      now.back() = left;
      touched_.back() = 1; // nothing is as it was, even where that leaves a pool alike
    }
    if (covered && !holds) {
      now.back() = 0; // the void of a covered cell is no room
    }
    side_.push_back(find_side(c));
    from_volume_.push_back(covered && !holds ? 0.0 : volume);
    to_volume_.push_back(special ? open_of(target_, c) : 0.0);
    swept_.push_back(0);
  }
  start_ = contents_;
  transfer_.clear();
}

template <int Dim> int EmbeddedRemap<Dim>::find_side(const std::array<int, 3>& c) const {
  std::array<std::array<int, 3>, 1 << Dim> nodes;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    nodes[static_cast<std::size_t>(p)] = {c[0] + step[0], c[1] + step[1], c[2] + step[2]};
  }
  for (const Levels<Dim>* levels : {&levels_[target_.at], &levels_[lag_.at], &std::as_const(e_).now}) {
    if (open_corners<Dim>(g_, *levels, c[0], c[1], c[2]) > 0) {
      return open_side<Dim>(g_, *levels, nodes);
    }
  }
  int side = -1; // buried: the faces it is nearest to
  for (const std::array<int, 3>& n : nodes) {
    const int foot = levels_[target_.at].foot_of[node_at(g_, g_.node_row(n[1], n[2]), n[0])];
    const int here = foot < 0 ? -1 : faced_side(levels_[target_.at].feet[static_cast<std::size_t>(foot)]);
    if (here < 0 || (side >= 0 && side != here)) {
      return -1;
    }
    side = here;
  }
  return side;
}

template <int Dim> double EmbeddedRemap<Dim>::own_aperture(const Levels<Dim>& levels, std::size_t c, std::size_t axis, const std::array<int, 3>& above) const {
  const auto nodes = face_nodes<Dim>(static_cast<int>(axis), above);
  const int side = open_side<Dim>(g_, levels, nodes);
  return side >= 0 && side_[c] >= 0 && side != side_[c] ? 0.0 : face_opening<Dim>(g_, levels, static_cast<int>(axis), above);
}

template <int Dim> void EmbeddedRemap<Dim>::find_roots(const Config& config, const std::vector<double>& volume, std::vector<int>& root) {
  const auto n = cells_.size();
  root.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    root[c] = static_cast<int>(c);
    const double whole = special_[dense(cells_[c])] != 0 ? whole_of(config, cells_[c]) : 0;
    if (special_[dense(cells_[c])] == 0 || !(volume[c] < sliver_share * whole) || (volume[c] == 0 && mass_of(c) == 0 && &config == &target_)) {
      continue;
    }
    double best = 0;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> to = cells_[c];
        to[axis] += side;
        if (!inside(to) || place_[dense(to)] < 0) {
          continue;
        }
        const auto q = static_cast<std::size_t>(place_[dense(to)]);
        const std::array<int, 3>& face = side < 0 ? cells_[c] : to;
        // A face open at either end of the motion joins: what is buried goes where it came from.
        const double open = std::max({own_aperture(levels_[lag_.at], c, axis, face), own_aperture(levels_[target_.at], c, axis, face), own_aperture(e_.now, c, axis, face)});
        const double room = special_[dense(to)] != 0 ? volume[q] : whole_of(config, to);
        if (room > volume[c] && open * room > best) {
          best = open * room;
          root[c] = static_cast<int>(q);
        }
      }
    }
  }
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t c = 0; c < n; ++c) {
      root[c] = root[static_cast<std::size_t>(root[c])];
    }
  }
}

template <int Dim> void EmbeddedRemap<Dim>::split(std::size_t c, std::size_t axis, bool high, double volume, std::span<double> out) const {
  const auto root = static_cast<std::size_t>(root_[c]);
  if (root != c) { // a sliver gives of its pool's mixture
    double all = 0;
    for (int m = 0; m < materials(); ++m) {
      all += std::max(pool_[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0);
    }
    for (int m = 0; m < materials() && all > 0; ++m) {
      out[static_cast<std::size_t>(m)] = volume * std::max(pool_[root][static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0) / all;
    }
    return;
  }
  const std::array<int, 3>& cell = cells_[c];
  const int r = g_.cell_row(cell[1], cell[2]);
  const auto parts = remap::reconstruct_cell<Dim>(g_, mesh_->materials, settings_.normal, r, cell[0]);
  if (parts.count == 1) {
    out[static_cast<std::size_t>(parts.present[0])] = volume;
    return;
  }
  double slab[remap::most_materials], sum = 0;
  const double part = std::min(1.0, volume / from_volume_[c]);
  remap::slab_volumes<Dim>(parts.planes, parts.count - 1, static_cast<int>(axis), high ? 1 - part : 0.0, high ? 1.0 : part, slab);
  for (int q = 0; q < parts.count; ++q) {
    sum += slab[q];
  }
  for (int q = 0; q < parts.count && sum > 0; ++q) {
    out[static_cast<std::size_t>(parts.present[q])] = slab[q] / sum * volume;
  }
}

template <int Dim> void EmbeddedRemap<Dim>::move_through_faces() {
  pool_contents(root_, pool_, pooled_);
  struct Crossing {
    std::size_t from, to;
  };
  const auto count = static_cast<std::size_t>(materials());
  std::vector<Crossing> crossings;
  std::vector<double> volume; // by crossing and material
  for (std::size_t low = 0; low < cells_.size(); ++low) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      std::array<int, 3> above = cells_[low];
      ++above[axis];
      if (!inside(above) || place_[dense(above)] < 0 || e_.closed[axis][dense(above)] == 0) {
        continue;
      }
      const double t = crossing(static_cast<int>(axis), above);
      const auto high = static_cast<std::size_t>(place_[dense(above)]);
      swept_[low] -= t;
      swept_[high] += t;
      if (t != 0) {
        crossings.push_back({t > 0 ? low : high, t > 0 ? high : low});
        volume.resize(volume.size() + count, 0.0);
        split(crossings.back().from, axis, t > 0, std::abs(t), std::span(volume).last(count));
      }
    }
  }
  // No cell of its own gives more of a material than it has.
  std::vector<double> given(cells_.size() * count, 0.0);
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    for (std::size_t m = 0; m < count; ++m) {
      given[static_cast<std::size_t>(root_[crossings[n].from]) * count + m] += volume[n * count + m];
    }
  }
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    const Crossing& x = crossings[n];
    const auto root = static_cast<std::size_t>(root_[x.from]);
    for (int m = 0; m < materials(); ++m) {
      const auto mm = static_cast<std::size_t>(m);
      const auto first = static_cast<std::size_t>(offset_[mm]);
      const double held = pool_[root][first];
      const double asked = volume[n * count + mm], all = given[root * count + mm], v = all > held ? asked * std::max(held, 0.0) / all : asked;
      if (!(v > 0)) {
        continue;
      }
      const double share = v / held;
      double mass = 0;
      for (int f = 0; f < fields(m); ++f) {
        const double amount = pool_[root][first + static_cast<std::size_t>(f)] * share;
        at(x.from, m, f) -= amount;
        at(x.to, m, f) += amount;
        mass = f == 1 ? amount : mass;
      }
      if (!is_void(m)) {
        transfer(x.from, x.to, mass, group_of(m));
      }
      touched_[x.from] = touched_[x.to] = 1;
    }
  }
}

template <int Dim> void EmbeddedRemap<Dim>::keep_swept_rooms() {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double swept = from_volume_[c] + swept_[c], open = to_volume_[c];
    if (special_[dense(cells_[c])] == 0 || !(open > 0) || !(swept > 0)) {
      continue;
    }
    const double whole = whole_of(target_, cells_[c]), slack = most_squeeze * whole, gap = std::max(at(c, materials() - 1, 0), 0.0);
    const double least = std::max(swept - gap - e_.squeeze * whole, 0.5 * open), most = gap > slack ? open : swept + slack;
    to_volume_[c] = std::clamp(open, least, std::max(least, most));
  }
}

template <int Dim> double EmbeddedRemap<Dim>::crossing(int axis, const std::array<int, 3>& above) const {
  const auto nodes = face_nodes<Dim>(axis, above);
  double sum = 0;
  for (std::size_t leg = 0; leg < Dim; ++leg) {
    SweptFace<Dim> f{};
    int side = open_side<Dim>(g_, levels_[leg], nodes);
    side = side >= 0 ? side : open_side<Dim>(g_, levels_[leg + 1], nodes);
    for (std::size_t q = 0; q < nodes.size(); ++q) {
      const int r = g_.node_row(nodes[q][1], nodes[q][2]), i = nodes[q][0];
      for (std::size_t d = 0; d < Dim; ++d) {
        f.before[q][d] = (*path_[leg])[d].row(r)[i];
        f.after[q][d] = (*path_[leg + 1])[d].row(r)[i];
      }
      f.level_before[q] = level_on<Dim>(g_, levels_[leg], nodes[q], side);
      f.level_after[q] = level_on<Dim>(g_, levels_[leg + 1], nodes[q], side);
    }
    sum += open_swept<Dim>(f, b_.axisymmetric);
  }
  return Dim == 2 && axis == 1 ? sum : -sum; // the face sweeps one way, what is there goes the other; 2D faces turn by axis
}

template <int Dim> void remap_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b, remap::Mesh<Dim>& mesh, const remap::Settings& settings, long order) {
  EmbeddedRemap<Dim> pass(scene, e, b, &mesh, settings, order);
  pass.run();
  mesh.closed = &e.closed;
}

template <int Dim> void pool_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b) {
  EmbeddedRemap<Dim>(scene, e, b, nullptr, {}, 0).pool();
}

template <int Dim> void restore_open_volumes(Embedding<Dim>& e, Block<Dim>& b, ThreadPool& pool) {
  find_cells<Dim>(b, b.position, e.now, pool, e.kind, e.cut);
  e.rows = e.now.rows;
  for (const CutCell<Dim>& c : e.cut) {
    b.volume.row(c.row)[c.cell[0]] = c.open;
  }
  for (const Pocket& p : e.pockets) {
    b.volume.row(b.grid.cell_row(p.cell[1], p.cell[2]))[p.cell[0]] = p.volume;
  }
}

template int EmbeddedRemap<2>::find_side(const std::array<int, 3>&) const;
template int EmbeddedRemap<3>::find_side(const std::array<int, 3>&) const;
template double EmbeddedRemap<2>::own_aperture(const Levels<2>&, std::size_t, std::size_t, const std::array<int, 3>&) const;
template double EmbeddedRemap<3>::own_aperture(const Levels<3>&, std::size_t, std::size_t, const std::array<int, 3>&) const;
template void remap_embedded<2>(Scene<2>&, Embedding<2>&, Block<2>&, remap::Mesh<2>&, const remap::Settings&, long);
template void remap_embedded<3>(Scene<3>&, Embedding<3>&, Block<3>&, remap::Mesh<3>&, const remap::Settings&, long);
template void pool_embedded<2>(Scene<2>&, Embedding<2>&, Block<2>&);
template void pool_embedded<3>(Scene<3>&, Embedding<3>&, Block<3>&);
template void restore_open_volumes<2>(Embedding<2>&, Block<2>&, ThreadPool&);
template void restore_open_volumes<3>(Embedding<3>&, Block<3>&, ThreadPool&);

} // namespace ballast
