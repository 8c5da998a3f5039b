// Two velocities where what slides meets the rest.
//
// One velocity a node welds what it touches: a bullet drags a layer of tissue a cell or two thick, a loss of speed that
// falls only with the cell size. Here each group's momentum is swept with its own mass fluxes and its own velocity; then
// the two meet without friction: across the interface they move as one (the impact conserves momentum, its energy is
// lost to heat), along it each keeps its velocity. After the multi-field contact of Bardenhagen, Brackbill and Sulsky,
// Comput. Methods Appl. Mech. Eng. 187 (2000) 529, with the remap in the part of the particles.
#include "remap/internal.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace ballast::remap {

namespace {

constexpr double largest_fall = 0.5; ///< of what a material has above its least energy that a return may take
constexpr double sliver_share = 1e-4; ///< of a cell, by mass: what holds less gets no heat back, it would boil
constexpr double least_share = 1e-3; ///< of the node's mass: a trace of either moves with the other
constexpr double no_rise = 1e-6;   ///< of a full step's gradient: round-off has no normal
constexpr double wall_rise = 0.1;  ///< of it: an interface whose gradient along a wall is less runs along the wall
constexpr double no_jump = 1e-10; ///< of the velocities: the round-off of a jump has a direction, but no meaning

/// Fraction of a cell that slides less the fraction of the rest; mirrored beyond the mesh.
template <int Dim> double contrast(const Mesh<Dim>& m, std::array<int, 3> cell) {
  for (std::size_t a = 0; a < 3; ++a) {
    const int n = m.grid.cells[a], mirrored = cell[a] < 0 ? -1 - cell[a] : cell[a] >= n ? 2 * n - 1 - cell[a] : cell[a];
    cell[a] = std::clamp(mirrored, 0, n - 1);
  }
  const int r = m.grid.cell_row(cell[1], cell[2]);
  double sum = 0;
  for (int q = 0; q < m.material_count(); ++q) {
    const TileStore& store = *m.materials[static_cast<std::size_t>(q)];
    if (!m.is_void(q) && store.has_row(r)) {
      sum += (m.slides(q) ? 1 : -1) * store.row(0, r)[cell[0]];
    }
  }
  return sum;
}

/// Normal of the interface at a node: a unit vector, zero on walls that the interface runs along; nothing without one.
/// It is the gradient of the fractions of the four cells around the node in each direction, smoothed by a hat two cells
/// wide on each side: within 3 degrees for a plane wherever it passes. (From two cells in each direction: 5 degrees at
/// the node, 30 a cell off, and all who slide would collide.)
template <int Dim> std::optional<Eigen::Matrix<double, Dim, 1>> normal_at(const Mesh<Dim>& m, int i, int j, int k) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  constexpr double value[4] = {1, 3, 3, 1}, slope[4] = {-1, -1, 1, 1};
  const int node[3] = {i, j, k};
  Vector rise = Vector::Zero();
  for (int q = 0; q < 1 << 2 * Dim; ++q) {
    const int at[3] = {q & 3, q >> 2 & 3, q >> 4 & 3};
    const double c = contrast(m, {i - 2 + at[0], j - 2 + at[1], Dim == 3 ? k - 2 + at[2] : 0});
    for (int a = 0; a < Dim; ++a) {
      double weight = c;
      for (int d = 0; d < Dim; ++d) {
        weight *= d == a ? slope[at[d]] : value[at[d]];
      }
      rise[a] += weight;
    }
  }
  Eigen::Matrix<double, Dim, Dim> along = Eigen::Matrix<double, Dim, Dim>::Identity();
  for (int a = 0; a < Dim; ++a) {
    const int last = m.grid.cells[static_cast<std::size_t>(a)];
    int low[3] = {i, j, k}, high[3] = {i, j, k};
    low[a] = std::max(node[a] - 1, 0);
    high[a] = std::min(node[a] + 1, last);
    for (std::size_t d = 0; d < Dim; ++d) {
      along(a, static_cast<int>(d)) = (m.target[d].row(m.grid.node_row(high[1], high[2]))[high[0]] -
                                       m.target[d].row(m.grid.node_row(low[1], low[2]))[low[0]]) / (high[a] - low[a]);
    }
  }
  Vector n = along.inverse() * rise;
  bool on_wall = false;
  for (int a = 0; a < Dim; ++a) {
    const auto ua = static_cast<std::size_t>(a);
    const bool wall = (node[a] == 0 && m.fixed[ua][0]) || (node[a] == m.grid.cells[ua] && m.fixed[ua][1]);
    n[a] = wall ? 0.0 : n[a];
    rise[a] = wall ? 0.0 : rise[a];
    on_wall = on_wall || wall;
  }
  constexpr double step = Dim == 3 ? 256 : 32; // of what takes all to what takes nothing, along one axis
  if (on_wall && rise.norm() < wall_rise * step) { // the wall mirrors the fractions: across it they have no gradient
    return Vector::Zero();
  }
  if (rise.norm() < no_rise * step) {
    return std::nullopt;
  }
  return n / n.norm();
}

template <int Dim> class Join {
public:
  explicit Join(Mesh<Dim>& m) : m_(m), s_(*m.sliding) {}

  /// Kinetic energy lost at the nodes of row (j, k), J.
  double row(int j, int k) {
    const int r = m_.grid.node_row(j, k);
    double lost = 0;
    const Span nodes = m_.nodes(r);
    for (int i = nodes.begin; i < nodes.end; ++i) {
      const double rest = std::max(m_.node_mass.row(r)[i], 0.0), sliding = std::max(s_.node_mass.row(r)[i], 0.0);
      m_.node_mass.row(r)[i] = rest + sliding;
      for (std::size_t d = 0; d < Dim; ++d) {
        s_.jump[d].row(r)[i] = 0;
      }
      if (sliding > 0) {
        const double loss = rest > 0 ? meet(i, j, k, rest, sliding) : take(r, i);
        s_.loss.row(r)[i] += loss;
        lost += loss;
      }
    }
    return lost;
  }

private:
  using Vector = Eigen::Matrix<double, Dim, 1>;

  double take(int r, int i) {
    for (std::size_t d = 0; d < Dim; ++d) {
      m_.velocity[d].row(r)[i] = s_.velocity[d].row(r)[i];
    }
    return 0;
  }

  double meet(int i, int j, int k, double rest, double sliding) {
    const int r = m_.grid.node_row(j, k);
    const double mass = rest + sliding;
    Vector u, v;
    for (int d = 0; d < Dim; ++d) {
      v[d] = m_.velocity[static_cast<std::size_t>(d)].row(r)[i];
      u[d] = s_.velocity[static_cast<std::size_t>(d)].row(r)[i];
    }
    const Vector apart = u - v;
    std::optional<Vector> n;
    if (std::min(rest, sliding) > least_share * mass) {
      n = normal_at(m_, i, j, k);
    }
    // As one, in all directions if there is no interface to slide along.
    Vector jump = n ? Vector(apart - n->dot(apart) * *n) : Vector::Zero();
    if (jump.squaredNorm() < no_jump * no_jump * (u.squaredNorm() + v.squaredNorm())) {
      jump.setZero();
    }
    const Vector together = apart - jump;
    v += sliding / mass * together + node_follows(sliding, mass) * jump;
    for (int d = 0; d < Dim; ++d) {
      m_.velocity[static_cast<std::size_t>(d)].row(r)[i] = v[d];
      s_.jump[static_cast<std::size_t>(d)].row(r)[i] = jump[d];
    }
    // The jump kept is the part of `apart` across what is lost (but for its round-off).
    return 0.5 * rest * sliding / mass * (together.squaredNorm() + 2 * together.dot(jump));
  }

  Mesh<Dim>& m_;
  Sliding<Dim>& s_;
};

/// Gives every node's loss to what slides around it, by mass.
template <int Dim> class Return {
public:
  explicit Return(Mesh<Dim>& m) : m_(m) {}

  /// Heat given to the cells of a slab, J.
  double slab(int s) const {
    double given = 0;
    std::vector<double> gain(static_cast<std::size_t>(m_.grid.cells[0]));
    for (int q = 0; q < m_.grid.rows_per_slab(); ++q) {
      const auto [j, k] = m_.grid.in_slab(s, q);
      if (gains(j, k, gain)) {
        given += give(m_.grid.cell_row(j, k), gain);
      }
    }
    return given;
  }

private:
  /// J/kg that what slides in the cells of a row gains; false: nothing does.
  bool gains(int j, int k, std::vector<double>& gain) const {
    const Grid& g = m_.grid;
    const Sliding<Dim>& s = *m_.sliding;
    const Span cells = m_.cells(g.cell_row(j, k));
    std::fill(gain.begin(), gain.end(), 0.0);
    bool any = false;
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      const int up[3] = {corner & 1, corner >> 1 & 1, corner >> 2 & 1}, index[3] = {0, j, k};
      double row_share = 1;
      for (int a = 1; a < Dim; ++a) {
        row_share *= share(a, index[a], up[a]);
      }
      const int r = g.node_row(j + up[1], k + up[2]);
      const double *loss = s.loss.row(r) + up[0], *mass = s.node_mass.row(r) + up[0];
      for (int i = cells.begin; i < cells.end; ++i) {
        if (loss[i] != 0 && mass[i] > 0) {
          gain[static_cast<std::size_t>(i)] += row_share * share(0, i, up[0]) * loss[i] / mass[i];
          any = true;
        }
      }
    }
    return any;
  }

  double share(int axis, int cell, int high) const {
    const auto a = static_cast<std::size_t>(axis);
    const double low = m_.low_share[a][static_cast<std::size_t>(cell + m_.grid.ghost[a])];
    return high != 0 ? 1 - low : low;
  }

  double give(int r, const std::vector<double>& gain) const {
    double given = 0;
    for (int q = 0; q < m_.material_count(); ++q) {
      TileStore& store = *m_.materials[static_cast<std::size_t>(q)];
      if (!m_.slides(q) || !store.has_row(r)) {
        continue;
      }
      const double *mass = std::as_const(store).row(1, r), *volume = m_.volume.row(r);
      const double least = m_.least_energy_of(q), sliver = sliver_share * m_.reference_density_of(q);
      double* e = store.row(2, r);
      const Span cells = m_.cells(r);
      for (int i = cells.begin; i < cells.end; ++i) {
        if (mass[i] > sliver * volume[i] && gain[static_cast<std::size_t>(i)] != 0) {
          const double most_fall = std::min(0.0, -largest_fall * (e[i] - least));
          const double rise = std::max(gain[static_cast<std::size_t>(i)], most_fall);
          e[i] += rise;
          given += mass[i] * rise;
        }
      }
    }
    return given;
  }

  Mesh<Dim>& m_;
};

/// Sum of f(index) over slabs or planes, in the same order for any threads.
template <class Function> double sum_in_order(int count, ThreadPool& pool, const Awake* awake, Function&& f) {
  std::vector<double> sums(static_cast<std::size_t>(count), 0.0);
  parallel_awake(pool, awake, count, [&](int begin, int end, int) {
    for (int q = begin; q < end; ++q) {
      sums[static_cast<std::size_t>(q)] = f(q);
    }
  });
  double sum = 0;
  for (const double s : sums) {
    sum += s;
  }
  return sum;
}

/// Sum of row(j, k) over all rows of nodes.
template <int Dim, class Row> double sum_node_rows(const Grid& g, ThreadPool& pool, const Awake* awake, Row&& row) {
  return sum_in_order(g.slabs() + 1, pool, awake, [&](int plane) {
    double sum = 0;
    for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
      sum += row(Dim == 3 ? q : plane, Dim == 3 ? plane : 0);
    }
    return sum;
  });
}

} // namespace

template <int Dim> void part_sliding(Mesh<Dim>& m, ThreadPool& pool) {
  Sliding<Dim>& s = *m.sliding;
  constexpr double round_off = 1e-13;
  const int rows = Dim == 3 ? m.grid.cells[1] + 1 : 1;
  parallel_awake(pool, m.awake, m.grid.slabs() + 1, [&](int begin, int end, int) {
    for (int q = begin * rows; q < end * rows; ++q) {
      const int r = Dim == 3 ? m.grid.node_row(q % rows, q / rows) : m.grid.node_row(q, 0);
      const Span nodes = m.nodes(r);
      double *mass = m.node_mass.row(r), *loss = s.loss.row(r), *by_sweeps = m.scratch->node_loss.row(r);
      const double* sliding = s.node_mass.row(r);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double* jump = s.jump[d].row(r);
        double *v = m.velocity[d].row(r), *u = s.velocity[d].row(r);
#pragma omp simd
        for (int i = nodes.begin; i < nodes.end; ++i) {
          const double follows = node_follows(sliding[i], mass[i]);
          u[i] = v[i] + (1 - follows) * jump[i];
          v[i] -= follows * jump[i];
        }
      }
      for (int i = nodes.begin; i < nodes.end; ++i) {
        const double rest = mass[i] - sliding[i];
        mass[i] = rest > round_off * mass[i] ? rest : 0.0;
        loss[i] = by_sweeps[i] = 0;
      }
    }
  });
}

template <int Dim> void join_sliding(Mesh<Dim>& m, ThreadPool& pool, Report& report) {
  Join<Dim> join(m);
  const double lost = sum_node_rows<Dim>(m.grid, pool, m.awake, [&](int j, int k) { return join.row(j, k); });
  report.kinetic_loss += lost;
  report.impact_loss += lost;
  Return<Dim> back(m);
  report.kinetic_returned += sum_in_order(m.grid.slabs(), pool, m.awake, [&](int slab) { return back.slab(slab); });
}

template void part_sliding<2>(Mesh<2>&, ThreadPool&);
template void part_sliding<3>(Mesh<3>&, ThreadPool&);
template void join_sliding<2>(Mesh<2>&, ThreadPool&, Report&);
template void join_sliding<3>(Mesh<3>&, ThreadPool&, Report&);

} // namespace ballast::remap
