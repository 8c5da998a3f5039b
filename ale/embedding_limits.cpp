// Viscosity of cut cells and the step that they allow.
#include "ale/embedding_cells.hpp"
#include "ale/embedding_motion.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

/// What one cell pushes the nodes of layers with, for a unit of pressure.
template <int Dim> struct BodyPushes {
  struct Push {
    int stack;
    std::size_t node;
    std::array<double, Dim> force;
  };
  std::array<Push, 2 * (1 << Dim) * BodyFoot<Dim>::most> push; // of a corner's two feet
  std::size_t count = 0;

  void add(const NodeFoot<Dim>& f, const std::array<double, Dim>& direction, double along) {
    for (std::size_t q = 0; q < f.foot.node.size(); ++q) {
      std::size_t at = 0;
      while (at < count && (push[at].stack != f.stack || push[at].node != f.foot.node[q])) {
        ++at;
      }
      if (at == count) {
        push[count++] = {f.stack, f.foot.node[q], {}};
      }
      for (std::size_t d = 0; d < Dim; ++d) {
        push[at].force[d] += f.foot.weight[q] * along * direction[d];
      }
    }
  }
  double mobility(const Scene<Dim>& scene) const {
    double sum = 0;
    for (std::size_t at = 0; at < count; ++at) {
      const Push& p = push[at];
      const double size = std::sqrt(dot<Dim>(p.force, p.force));
      if (size > 0) {
        std::array<double, Dim> along = p.force;
        for (double& a : along) {
          a /= size;
        }
        const Layers<Dim>& l = scene.layers[static_cast<std::size_t>(p.stack)];
        sum += size * size / (l.stack.mass[p.node] + l.load.mass_along(p.node, along));
      }
    }
    return sum;
  }
};

} // namespace

template <int Dim> double closing_rate(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const OpenPart<Dim> part = open_part(level_cell<Dim>(b.grid, b.position, e.now, c.cell), b.axisymmetric);
  return -opening_rate<Dim>(scene, e, c, part, corner_velocities<Dim>(b.grid, b.velocity, c.cell)) / part.volume;
}

template <int Dim> void embedded_rates(const Embedding<Dim>& e, Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  parallel_rows(pool, rows_beside<Dim>(g, e.rows), [&](int, int j, int k) {
    const int r = g.cell_row(j, k);
    for (int i = 0; i < g.cells[0]; ++i) {
      const int kind = e.kind_of(g, r, i);
      // The block's own were made with the open part for a volume: rates in 2D, lengths in 3D (ale/viscosity).
      if (kind == open_cell) {
        continue;
      }
      const double room = b.volume.row(r)[i];
      const double open = kind >= 0 ? room / e.cut[static_cast<std::size_t>(kind)].whole : 0.0;
      const double longer = Dim == 2 || !(b.density.row(r)[i] > 0) ? 1.0 : kind >= 0 ? 1 / open : whole_volume<Dim>(b, b.position, i, j, k) / room; // a pocket's, too
      for (std::size_t d = 0; d < Dim; ++d) {
        b.strain_rate[d].row(r)[i] *= Dim == 2 || kind == covered_cell ? open : 1.0;
        b.length[d].row(r)[i] *= longer;
      }
    }
  });
}

/// What a cut cell allows.
struct CutLimit {
  double dt = std::numeric_limits<double>::infinity(); ///< s, by sound
  double rate = 0;                                     ///< 1/s: of its room, with its root's
};

/// Viscosity by the speed at which the open part closes; the stable step from the cell's own frequency,
/// w^2 = K/T (sum of B_p^2/M_p over what its pressure moves), twice that with its neighbours: 2 / (sqrt(2) w).
template <int Dim> static CutLimit limit_cut(const Scene<Dim>& scene, const Embedding<Dim>& e, CutCell<Dim>& c) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const double quadratic = scene.numerics.quadratic_q * (2.0 / 3.0), linear = scene.numerics.linear_q;
  const int i = c.cell[0];
  const double density = b.density.row(c.row)[i], sound = b.wave_speed.row(c.row)[i], modulus = b.modulus.row(c.row)[i];
  c.viscosity = 0;
  if (!(density > 0 && modulus > 0) || is_wisp(b, c)) {
    return {};
  }
  const auto u = corner_velocities<Dim>(g, b.velocity, c.cell);
  const OpenPart<Dim> part = open_part(level_cell<Dim>(g, b.position, e.now, c.cell), b.axisymmetric);
  const double room = std::max(part.volume, b.volume.row(c.row)[i]);
  const Pool pool = pool_of(scene, e, b, c, 1.0, opening_rate<Dim>(scene, e, c, part, u), room); // a sliver closes with its root; a second's change: the rate
  const double rate = pool.change / pool.volume;
  double active = 0;
  if (rate < 0) {
    const double across = c.width * std::min(1.0, pool.volume / c.whole); // what is thin closes fast for little speed
    const double jump = -rate * across, a = quadratic * jump, lin = linear * sound * std::min(1.0, jump / (1e-7 * sound));
    active = a + std::sqrt(a * a + lin * lin);
    c.viscosity = density * jump * active;
  }
  double mobility = 0;
  BodyPushes<Dim> pushes;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto at = static_cast<std::size_t>(p);
    const auto to = corner_step<Dim>(p);
    const double mass = b.node_mass.row(g.node_row(c.cell[1] + to[1], c.cell[2] + to[2]))[c.cell[0] + to[0]];
    const NodeFoot<Dim>* f = foot_at(e, c, p);
    std::array<double, Dim> force = part.at_node[at];
    if (f != nullptr) {
      for (std::size_t d = 0; d < Dim; ++d) {
        force[d] += part.at_level[at] * f->foot.normal[d];
      }
      pushes.add(*f, f->foot.normal, -part.at_level[at]);
      const NodeFoot<Dim>& own = *foot_of_node(e, g, c, p);
      if (own.tied) {
        const double along = dot<Dim>(force, own.tie);
        pushes.add(own, own.carry, along);
        for (std::size_t d = 0; d < Dim; ++d) {
          force[d] -= along * own.tie[d];
        }
      }
    }
    mobility += mass > 0 ? dot<Dim>(force, force) / mass : 0.0;
  }
  mobility += pushes.mobility(scene);
  const double stiff = (density * (sound * sound + 4 * active * active)) / pool.volume;
  return {scene.numerics.cfl * std::sqrt(2.0) / std::sqrt(stiff * mobility), rate};
}

template <int Dim> void limit_embedded(Scene<Dim>& scene, Embedding<Dim>& e, DtLimit& limit) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  std::vector<CutLimit> found(e.cut.size());
  std::vector<double> speed(e.now.feet.size());
  parallel_ranges(*scene.pool, static_cast<int>(found.size()), [&](int begin, int end, int) {
    for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n) {
      found[n] = limit_cut(scene, e, e.cut[n]);
    }
  });
  parallel_ranges(*scene.pool, static_cast<int>(speed.size()), [&](int begin, int end, int) {
    for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n) {
      speed[n] = std::abs(surface_speed<Dim>(scene, e.now.feet[n], e.now.feet[n].foot.normal));
    }
  });
  const double most = scene.numerics.max_volume_change;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const CutCell<Dim>& c = e.cut[n];
    const auto owner = b.owner_row(c.row)[c.cell[0]];
    if (found[n].dt < limit.dt) {
      limit = {found[n].dt, e.block, c.cell, owner, DtCause::sound};
    }
    if (found[n].rate < 0 && -found[n].rate * limit.dt > most) {
      limit = {most / -found[n].rate, e.block, c.cell, owner, DtCause::volume_change};
    }
  }
  const double width = 0.4 * e.least_width;
  for (const double fast : speed) { // a body travels less than half a cell
    if (fast * limit.dt > width) {
      limit = {width / fast, e.block, {-1, -1, -1}, -1, DtCause::volume_change};
    }
  }
}

#define BALLAST_INSTANTIATE(D) \
  template double closing_rate<D>(const Scene<D>&, const Embedding<D>&, const CutCell<D>&); \
  template void embedded_rates<D>(const Embedding<D>&, Block<D>&, ThreadPool&); \
  template void limit_embedded<D>(Scene<D>&, Embedding<D>&, DtLimit&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
