// Momentum goes corner by corner with the mass, one transfer after the other, at the velocity that the corner it leaves has by then.
// What slides and the rest have velocities, and momenta, of their own (remap/mesh.hpp, Sliding).
#include "ale/embedding_cells.hpp"
#include "ale/embedding_pass.hpp"

namespace ballast {

namespace {

/// What one group holds of a node.
template <int Dim> struct NodeShare {
  double start = 0, mass = 0; ///< kg, as it goes
  std::array<double, Dim> velocity = {}, momentum = {};
  std::array<double, Dim> least, most; ///< of the velocities that meet there
};

template <int Dim> struct PassNode {
  std::array<int, 3> at;
  int row;
  std::array<NodeShare<Dim>, 2> share;
};

template <int Dim> double group_mass(const Block<Dim>& b, int r, int i, std::size_t group) {
  const double mass = b.node_mass.row(r)[i], sliding = b.any_sliding() ? std::min(b.sliding.node_mass.row(r)[i], mass) : 0.0;
  return group == 1 ? sliding : mass - sliding;
}

template <int Dim> double kinetic(const NodeShare<Dim>& s, double mass) {
  double square = 0;
  for (const double u : s.velocity) {
    square += u * u;
  }
  return 0.5 * mass * square;
}

/// A group's velocity from its momentum.
template <int Dim> void set_velocity(NodeShare<Dim>& s) {
  for (std::size_t d = 0; d < Dim && s.mass > 0; ++d) {
    s.velocity[d] += (s.momentum[d] - s.mass * s.velocity[d]) / s.mass;
  }
}

/// The node's velocity and jump from its groups'.
template <int Dim> void put_back(Block<Dim>& b, const PassNode<Dim>& n) {
  const int r = n.row, i = n.at[0];
  const auto& [rest, slides] = n.share;
  for (std::size_t d = 0; d < Dim; ++d) {
    double& u = b.velocity[d].row(r)[i];
    if (rest.mass > 0 && slides.mass > 0) {
      const double jump = slides.velocity[d] - rest.velocity[d];
      b.sliding.jump[d].row(r)[i] = jump;
      u = rest.velocity[d] + remap::node_follows(b.sliding.node_mass.row(r)[i], b.node_mass.row(r)[i]) * jump;
    } else {
      u = slides.mass > 0 ? slides.velocity[d] : rest.mass > 0 ? rest.velocity[d] : u;
      if (b.any_sliding()) {
        b.sliding.jump[d].row(r)[i] = 0;
      }
    }
  }
}

} // namespace

template <int Dim> void EmbeddedRemap<Dim>::move_momentum() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<PassNode<Dim>> nodes;
  std::vector<int> of(static_cast<std::size_t>(g_.node_pitch()) * static_cast<std::size_t>(g_.node_rows()), -1);
  const auto entry = [&](const std::array<int, 3>& at) {
    const int r = g_.node_row(at[1], at[2]), i = at[0];
    int& where = of[node_at(g_, r, i)];
    if (where < 0) {
      where = static_cast<int>(nodes.size());
      PassNode<Dim> n{at, r, {}};
      for (const std::size_t group : {0, 1}) {
        NodeShare<Dim>& s = n.share[group];
        s.start = s.mass = group_mass(b_, r, i, group);
        s.least.fill(infinity); // what holds nothing has no velocity of its own
        s.most.fill(-infinity);
        for (std::size_t d = 0; d < Dim; ++d) {
          s.velocity[d] = velocity_of(b_, group == 1, d, r, i);
          s.momentum[d] = s.mass * s.velocity[d];
          if (s.mass > 0) {
            s.least[d] = s.most[d] = s.velocity[d];
          }
        }
      }
      nodes.push_back(n);
    }
    return static_cast<std::size_t>(where);
  };
  const auto corner = [&](std::size_t c, int bits) {
    std::array<int, 3> n = cells_[c];
    for (std::size_t a = 0; a < Dim; ++a) {
      n[a] += bits >> a & 1;
    }
    return entry(n);
  };
  const auto for_neighbours = [&](const std::array<int, 3>& at, auto&& visit) {
    for (int q = 0; q < 2 * Dim; ++q) {
      std::array<int, 3> to = at;
      const auto a = static_cast<std::size_t>(q / 2);
      to[a] += q % 2 == 0 ? -1 : 1;
      if (to[a] >= 0 && to[a] <= g_.cells[a]) {
        visit(entry(to));
      }
    }
  };
  for (const Transfer& t : transfer_) {
    const auto from = static_cast<std::size_t>(t.from), to = static_cast<std::size_t>(t.to);
    for (int bits = 0; bits < (1 << Dim); ++bits) {
      const std::size_t low = corner(from, bits), high = corner(to, bits); // entries move while they are made
      NodeShare<Dim>&a = nodes[low].share[t.group], &z = nodes[high].share[t.group];
      const double leaves = t.mass * corner_share(b_, bits, cells_[from][0], cells_[from][1], cells_[from][2]);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double now = a.mass > 0 ? a.momentum[d] / a.mass : a.velocity[d];
        const double u = a.least[d] <= a.most[d] ? std::clamp(now, a.least[d], a.most[d]) : now, p = leaves * u;
        a.momentum[d] -= p;
        z.momentum[d] += p;
        z.least[d] = std::min(z.least[d], u);
        z.most[d] = std::max(z.most[d], u);
      }
      a.mass -= leaves;
      z.mass += leaves;
    }
  }
  const std::size_t met = nodes.size(); // what else is entered from here on takes what is too much
  for (std::size_t n = 0; n < met; ++n) {
    for_neighbours(std::array<int, 3>(nodes[n].at), [](std::size_t) {});
  }
  double before = 0, after = 0;
  for (const PassNode<Dim>& n : nodes) {
    before += kinetic(n.share[0], n.share[0].start) + kinetic(n.share[1], n.share[1].start);
  }
  compute_node_mass(b_, *scene_.pool);
  for (PassNode<Dim>& n : nodes) {
    for (const std::size_t group : {0, 1}) {
      n.share[group].mass = group_mass(b_, n.row, n.at[0], group);
    }
  }
  // A node that more passes through than stays may be left with a speed that nothing there had: what is too much of its
  // momentum goes to its heaviest neighbour, to what else there is at the node, or out with an entry.
  for (std::size_t n = 0; n < met; ++n) {
    for (const std::size_t group : {0, 1}) {
      NodeShare<Dim>& s = nodes[n].share[group];
      NodeShare<Dim>* heaviest = nodes[n].share[1 - group].mass > 0 ? &nodes[n].share[1 - group] : nullptr;
      double weight = s.mass;
      for_neighbours(std::array<int, 3>(nodes[n].at), [&](std::size_t q) {
        NodeShare<Dim>& other = nodes[q].share[group];
        if (other.mass > weight) {
          heaviest = &other;
          weight = other.mass;
        }
      });
      for (std::size_t d = 0; d < Dim; ++d) {
        const double u = s.mass > 0 ? s.momentum[d] / s.mass : 0.0;
        const double kept = s.mass > 0 && s.least[d] <= s.most[d] ? s.mass * std::clamp(u, s.least[d], s.most[d]) : 0.0, excess = s.momentum[d] - kept;
        s.momentum[d] = kept;
        (heaviest != nullptr ? heaviest->momentum[d] : scene_.ledger.momentum_out[d]) += excess;
      }
    }
  }
  for (PassNode<Dim>& n : nodes) {
    const auto old = n.share;
    for (NodeShare<Dim>& s : n.share) {
      set_velocity(s);
      for (std::size_t d = 0; d < Dim && s.mass > 0; ++d) { // what has come to a wall
        if (const double* wall = held_along(b_, n.at, d)) {
          scene_.ledger.momentum_out[d] += s.mass * (s.velocity[d] - *wall);
          s.velocity[d] = *wall;
        }
      }
      after += kinetic(s, s.mass);
    }
    if (n.share[0].velocity != old[0].velocity || n.share[1].velocity != old[1].velocity || n.share[0].mass != old[0].start || n.share[1].mass != old[1].start) {
      put_back(b_, n);
    }
  }
  scene_.ledger.remap_kinetic_loss += before - after;
}

template void EmbeddedRemap<2>::move_momentum();
template void EmbeddedRemap<3>::move_momentum();

} // namespace ballast
