// One split sweep of momentum on the dual mesh.
//
// The masses that cross between nodes are those of remap/dual_flux. Velocity is carried by the upwind node's limited value
// in the mass coordinate. Kinetic energy carried as its own scalar, less what the new velocities hold, is the loss.
#include "core/rows.hpp"
#include "remap/dual_flux.hpp"
#include "remap/internal.hpp"
#include "remap/limiter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ballast::remap {

namespace {

/// No slope where the cell behind a donor of velocity holds less than this of the mass ahead: nothing, whose velocity means
/// nothing, or, where materials slide, a group's edge (docs/numerics.md). Below 1/4 (strong shock) and 1/3.4 (graded axis).
constexpr double empty_share = 1e-6, edge_share = 0.2;

struct SlabSums {
  std::array<double, 3> momentum_out = {0, 0, 0};
  double kinetic_out = 0, loss = 0;
};

/// The nodes' share in one group of materials, and what moves it: all of them, or what slides and the rest apart.
template <int Dim> struct Group {
  RowField& node_mass;
  std::array<RowField, Dim>&velocity, &next_velocity;
  const std::array<RowField, Dim>& mass_flux;
  const RowField& cell_mass;
};

template <int Dim> class NodeSweep {
public:
  NodeSweep(Mesh<Dim>& mesh, const Group<Dim>& group, const Settings& settings, RowField& loss, int axis, bool first)
      : m_(mesh), g_(group), s_(settings), loss_(loss), axis_(axis), first_(first), nodes_(mesh.grid.cells[0] + 1),
        dual_(mesh, group.cell_mass, group.mass_flux, axis) {
    for (auto* v : {&central_, &edge_, &lost_}) {
      v->assign(static_cast<std::size_t>(dual_.links() + 4), 0.0);
    }
  }

  /// Momentum and kinetic energy through the links below the nodes of row (j, k): out[0] mass,
  /// out[1..Dim] momentum, out[Dim + 1] kinetic energy.
  void links(int j, int k, std::vector<double>* out) {
    const Grid& g = m_.grid;
    const int r = g.node_row(j, k), stride = g.node_row_stride(axis_), shift = axis_ == 0 ? 1 : 0;
    const Span awake = links_of(r);
    dual_.compute(j, k, awake);
    const double *t = dual_.flux(), *central = central_.data(), *edge = edge_.data();
    std::copy(t + awake.begin, t + awake.end, out[0].data() + awake.begin);
    std::fill(out[Dim + 1].begin() + awake.begin, out[Dim + 1].begin() + awake.end, 0.0);
    link_factors(r, stride, shift, awake);
    const double unlimited = s_.limit ? 0 : 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      const RowField& u = g_.velocity[d];
      const double *u0 = u.row(r - 2 * stride) - 2 * shift, *u1 = u.row(r - stride) - shift;
      const double *u2 = u.row(r), *u3 = u.row(r + stride) + shift;
      double *momentum = out[d + 1].data(), *kinetic = out[Dim + 1].data();
#pragma omp simd
      for (int i = awake.begin; i < awake.end; ++i) {
        // Loads first, then selections: conditional loads would keep the loop from vectorising.
        const double ua = u0[i], ub = u1[i], uc = u2[i], ud = u3[i], give = t[i];
        const std::uint64_t positive = where_positive(give);
        const double donor = select(positive, ub, uc), behind = select(positive, ua, ud), ahead = select(positive, uc, ub);
        const double value = donor + limited_rise(behind, donor, ahead, central[i], edge[i], unlimited);
        momentum[i] = give * value;
        kinetic[i] += 0.5 * give * value * value;
      }
    }
  }

  /// New velocity and mass of node row (j, k) from the links below and above it.
  void update(int j, int k, const std::vector<double>* low, const std::vector<double>* high, SlabSums& sums) {
    const Grid& g = m_.grid;
    const int r = g.node_row(j, k), step = axis_ == 0 ? 1 : 0;
    const Span awake = m_.nodes(r);
    const double* mass = g_.node_mass.row(r);
    double *next_mass = next_mass_row(r), *loss = lost_.data();
    const double *ml = low[0].data(), *mh = high[0].data() + step;
    const double *kl = low[Dim + 1].data(), *kh = high[Dim + 1].data() + step;
#pragma omp simd
    for (int i = awake.begin; i < awake.end; ++i) {
      next_mass[i] = mass[i] + ml[i] - mh[i];
      loss[i] = kl[i] - kh[i];
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double *u = g_.velocity[d].row(r), *pl = low[d + 1].data(), *ph = high[d + 1].data() + step;
      double* next = g_.next_velocity[d].row(r);
#pragma omp simd
      for (int i = awake.begin; i < awake.end; ++i) {
        const bool holds = next_mass[i] > 1e-9 * (mass[i] + std::abs(ml[i]) + std::abs(mh[i]));
        // (M u + p_low - p_high) / M_next as a change of u: a uniform velocity stays so to the bit.
        const double change = (pl[i] - ml[i] * u[i]) - (ph[i] - mh[i] * u[i]);
        const double old = u[i], m1 = next_mass[i], rise = change / (holds ? m1 : 1.0);
        const double now = old + (holds ? rise : 0.0);
        next[i] = now;
        loss[i] += 0.5 * (mass[i] * old * old - m1 * now * now); // exactly 0 where no mass passes
      }
    }
    boundary_sums(j, k, low, high, step, sums);
    hold_walls(j, k, sums);
    double* all = loss_.row(r);
    const double* lost = lost_.data();
    // The last awake node, unless it is the row's last, loses nothing: without it the lanes are those of the whole row.
    sums.loss += lane_sum(lost + awake.begin, awake.count() - (awake.end == nodes_ ? 0 : 1));
    if (first_) {
      std::copy(lost + awake.begin, lost + awake.end, all + awake.begin);
      return;
    }
#pragma omp simd
    for (int i = awake.begin; i < awake.end; ++i) {
      all[i] += lost[i];
    }
  }

  /// Nodes of a wall keep its velocity; their excess kinetic energy is loss, their momentum the wall's.
  void hold_walls(int j, int k, SlabSums& sums) {
    const Grid& g = m_.grid;
    const int r = g.node_row(j, k), index[3] = {0, j, k};
    const double* mass = next_mass_row(r);
    double* loss = lost_.data();
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        const int at = side == 0 ? 0 : g.cells[axis];
        if (!m_.fixed[axis][side] || (axis > 0 && index[axis] != at)) {
          continue;
        }
        const auto component = static_cast<std::size_t>(m_.fixed_component[axis][side]);
        double* u = g_.next_velocity[component].row(r);
        const double want = m_.fixed_velocity[axis][side];
        const Span awake = m_.nodes(r);
        const int first = axis == 0 ? std::max(at, awake.begin) : awake.begin, end = axis == 0 ? std::min(at + 1, awake.end) : awake.end;
        for (int i = first; i < end; ++i) {
          if (u[i] != want) {
            // m (u^2 - w^2)/2 = m (u - w)^2/2, lost, + w m (u - w), the wall's work.
            loss[i] += 0.5 * mass[i] * (u[i] - want) * (u[i] - want);
            sums.kinetic_out += want * mass[i] * (u[i] - want);
            sums.momentum_out[component] += mass[i] * (u[i] - want);
            u[i] = want;
          }
        }
      }
    }
  }

  double* next_mass_row(int r) { return next_mass_->row(r); }
  void set_next_mass(RowField* f) { next_mass_ = f; }

private:
  /// Links below the nodes of a row, along axis 0 also the one above the last, that end at an awake node.
  Span links_of(int r) const {
    const Span here = m_.nodes(r);
    if (axis_ == 0) {
      return here.empty() ? here : Span{here.begin, here.end + 1};
    }
    return hull(here, m_.nodes(r - m_.grid.node_row_stride(axis_)));
  }

  /// What the links' masses say about rises of velocity along them; the same for every component.
  void link_factors(int r, int stride, int shift, Span links) {
    const double *t = dual_.flux(), *lo = dual_.before(), *mid = dual_.between(), *hi = dual_.after();
    const double *low = dual_.low(), *high = dual_.high();
    const double *held1 = g_.node_mass.row(r - stride) - shift, *held2 = g_.node_mass.row(r);
    double *central = central_.data(), *edge = edge_.data();
    const double hollow_share = m_.sliding != nullptr || m_.has_void ? edge_share : empty_share;
#pragma omp simd
    for (int i = links.begin; i < links.end; ++i) {
      const double give = t[i], m = mid[i], w1 = low[i] * m, w2 = high[i] * m, h1 = held1[i], h2 = held2[i], mass_a = lo[i], mass_c = hi[i];
      const std::uint64_t positive = where_positive(give);
      const double behind = select(positive, mass_a, mass_c) + 1e-300, ahead = m + 1e-300;
      // From the node to the middle of what leaves; no further than what stays behind, so that a node
      // beside void that gives all it has gives its own velocity.
      const double left = select(positive, h1, h2) - std::abs(give);
      const double middle = select(positive, w1, w2) - 0.5 * std::abs(give);
      const double least = middle < left ? middle : left, distance = least > 0 ? least : 0.0;
      const RiseFactors k = rise_factors(behind, ahead, behind > ahead ? behind : ahead, distance);
      const bool hollow = behind < hollow_share * ahead;
      central[i] = hollow ? 0.0 : k.central;
      edge[i] = hollow ? 0.0 : k.edge;
    }
  }

  void boundary_sums(int j, int k, const std::vector<double>* low, const std::vector<double>* high, int step, SlabSums& sums) {
    const Grid& g = m_.grid;
    const auto add_link = [&](const std::vector<double>* l, std::size_t i, double sign) {
      for (std::size_t d = 0; d < Dim; ++d) {
        sums.momentum_out[d] += sign * l[d + 1][i];
      }
      sums.kinetic_out += sign * l[Dim + 1][i];
    };
    const Span awake = m_.nodes(g.node_row(j, k));
    if (axis_ == 0) {
      if (awake.begin == 0) {
        add_link(low, 0, -1);
      }
      if (awake.end == nodes_) {
        add_link(high, static_cast<std::size_t>(nodes_ - 1 + step), 1);
      }
      return;
    }
    const int index = axis_ == 1 ? j : k, n = g.cells[static_cast<std::size_t>(axis_)];
    for (int i = awake.begin; i < awake.end; ++i) {
      if (index == 0) {
        add_link(low, static_cast<std::size_t>(i), -1);
      }
      if (index == n) {
        add_link(high, static_cast<std::size_t>(i), 1);
      }
    }
  }

  Mesh<Dim>& m_;
  const Group<Dim> g_;
  const Settings& s_;
  RowField& loss_;
  RowField* next_mass_ = nullptr;
  int axis_;
  bool first_; ///< of the sweeps whose losses are returned together
  int nodes_;
  DualFlux<Dim> dual_;
  std::vector<double> central_, edge_, lost_;
};

template <int Dim> void copy_awake_nodes(const Mesh<Dim>& m, const RowField& from, RowField& to, ThreadPool& pool) {
  const Grid& g = m.grid;
  const int rows = Dim == 3 ? g.cells[1] + 1 : 1;
  parallel_awake(pool, m.awake, g.slabs() + 1, [&](int begin, int end, int) {
    for (int q = begin * rows; q < end * rows; ++q) {
      const int r = Dim == 3 ? g.node_row(q % rows, q / rows) : g.node_row(q, 0);
      const Span nodes = m.nodes(r);
      std::copy(from.row(r) + nodes.begin, from.row(r) + nodes.end, to.row(r) + nodes.begin);
    }
  });
}

template <int Dim>
void sweep_group(Mesh<Dim>& m, const Group<Dim>& group, const Settings& settings, ThreadPool& pool, int axis, bool first, Report& report) {
  const Grid& g = m.grid;
  for (std::size_t d = 0; d < Dim; ++d) {
    m.exchange_velocity(group.velocity[d], static_cast<int>(d));
  }
  RowField &loss = m.scratch->node_loss, &next_mass = m.scratch->next_node_mass;
  const int slabs = g.slabs() + 1, rows = Dim == 3 ? g.cells[1] + 1 : 1;
  std::vector<SlabSums> sums(static_cast<std::size_t>(slabs));
  parallel_awake(pool, m.awake, slabs, [&](int begin, int end, int) {
    NodeSweep<Dim> sweep(m, group, settings, loss, axis, first);
    sweep.set_next_mass(&next_mass);
    using Links = std::array<std::vector<double>, Dim + 2>;
    Links empty;
    for (auto& l : empty) {
      l.assign(static_cast<std::size_t>(g.cells[0] + 2), 0.0);
    }
    const bool outer = axis == Dim - 1;
    std::vector<Links> carry(static_cast<std::size_t>(outer ? rows : 1), empty);
    Links next = empty;
    for (int s = begin; s < end; ++s) {
      SlabSums& slab = sums[static_cast<std::size_t>(s)];
      for (int q = 0; q < rows; ++q) {
        const int j = Dim == 3 ? q : s, k = Dim == 3 ? s : 0;
        Links& low = carry[static_cast<std::size_t>(outer ? q : 0)];
        const int r = g.node_row(j, k);
        if (m.nodes(r).empty()) {
          continue;
        }
        if (axis == 0 || (outer ? s == begin : q == 0) || m.nodes(r - g.node_row_stride(axis)).empty()) { // else carried
          sweep.links(j, k, low.data());
        }
        if (axis == 0) {
          sweep.update(j, k, low.data(), low.data(), slab);
        } else {
          sweep.links(axis == 1 ? j + 1 : j, axis == 2 ? k + 1 : k, next.data());
          sweep.update(j, k, low.data(), next.data(), slab);
          std::swap(low, next);
        }
      }
    }
  });
  for (std::size_t d = 0; d < Dim; ++d) {
    group.velocity[d].swap(group.next_velocity[d]);
  }
  if (m.awake == nullptr || m.awake->share() == 1) {
    group.node_mass.swap(next_mass);
  } else {
    copy_awake_nodes(m, next_mass, group.node_mass, pool); // what sleeps has no second copy of its mass
  }
  for (const SlabSums& s : sums) {
    for (std::size_t d = 0; d < 3; ++d) {
      report.momentum_out[d] += s.momentum_out[d];
    }
    report.kinetic_out += s.kinetic_out;
    report.kinetic_loss += s.loss;
  }
}

} // namespace

template <int Dim>
void sweep_nodes(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, int axis, bool first, Report& report) {
  const bool alone = m.sliding == nullptr;
  sweep_group<Dim>(m, {m.node_mass, m.velocity, m.next_velocity, m.mass_flux, m.scratch->cell_mass}, settings, pool, axis, first && alone, report);
  if (!alone) {
    Sliding<Dim>& s = *m.sliding;
    sweep_group<Dim>(m, {s.node_mass, s.velocity, s.next_velocity, s.mass_flux, s.cell_mass}, settings, pool, axis, false, report);
  }
}

template void sweep_nodes<2>(Mesh<2>&, const Settings&, ThreadPool&, int, bool, Report&);
template void sweep_nodes<3>(Mesh<3>&, const Settings&, ThreadPool&, int, bool, Report&);

} // namespace ballast::remap
