// Momentum goes corner by corner with the mass, one transfer after the other, at the velocity that the corner it leaves has by then.
#include "ale/embedding_pass.hpp"

namespace ballast {

template <int Dim> void EmbeddedRemap<Dim>::move_momentum() {
  std::vector<std::size_t> nodes;
  std::vector<int> row, index;
  std::vector<int> of(static_cast<std::size_t>(g_.node_pitch()) * static_cast<std::size_t>(g_.node_rows()), -1);
  std::vector<std::array<double, Dim>> momentum, least, most; // of the velocities that meet at a node
  std::vector<std::array<int, 3>> place;
  std::vector<double> mass; // as it goes
  const auto entry = [&](const std::array<int, 3>& n) {
    const int r = g_.node_row(n[1], n[2]);
    int& at_node = of[node_at(g_, r, n[0])];
    if (at_node < 0) {
      at_node = static_cast<int>(momentum.size());
      row.push_back(r);
      index.push_back(n[0]);
      std::array<double, Dim> p{};
      for (std::size_t d = 0; d < Dim; ++d) {
        p[d] = b_.node_mass.row(r)[n[0]] * b_.velocity[d].row(r)[n[0]];
      }
      momentum.push_back(p);
      std::array<double, Dim> u{};
      for (std::size_t d = 0; d < Dim; ++d) {
        u[d] = b_.velocity[d].row(r)[n[0]];
      }
      const bool held = b_.node_mass.row(r)[n[0]] > 0; // what holds nothing has no velocity of its own
      least.push_back(u);
      most.push_back(u);
      if (!held) {
        least.back().fill(std::numeric_limits<double>::infinity());
        most.back().fill(-std::numeric_limits<double>::infinity());
      }
      place.push_back(n);
      mass.push_back(b_.node_mass.row(r)[n[0]]);
    }
    return static_cast<std::size_t>(at_node);
  };
  const auto corner = [&](std::size_t c, int bits) {
    std::array<int, 3> n = cells_[c];
    for (std::size_t a = 0; a < Dim; ++a) {
      n[a] += bits >> a & 1;
    }
    return entry(n);
  };
  for (const Transfer& t : transfer_) {
    const auto from = static_cast<std::size_t>(t.from), to = static_cast<std::size_t>(t.to);
    for (int bits = 0; bits < (1 << Dim); ++bits) {
      const std::size_t a = corner(from, bits), z = corner(to, bits);
      const double leaves = t.mass * corner_share(b_, bits, cells_[from][0], cells_[from][1], cells_[from][2]);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double now = mass[a] > 0 ? momentum[a][d] / mass[a] : b_.velocity[d].row(row[a])[index[a]];
        const double u = least[a][d] <= most[a][d] ? std::clamp(now, least[a][d], most[a][d]) : now, p = leaves * u;
        momentum[a][d] -= p;
        momentum[z][d] += p;
        least[z][d] = std::min(least[z][d], u);
        most[z][d] = std::max(most[z][d], u);
      }
      mass[a] -= leaves;
      mass[z] += leaves;
    }
  }
  const std::size_t met = momentum.size(); // what else is entered from here on takes what is too much
  for (std::size_t n = 0; n < met; ++n) {
    for (int q = 0; q < 2 * Dim; ++q) {
      std::array<int, 3> to = place[n];
      const auto a = static_cast<std::size_t>(q / 2);
      to[a] += q % 2 == 0 ? -1 : 1;
      if (to[a] >= 0 && to[a] <= g_.cells[a]) {
        entry(to);
      }
    }
  }
  double before = 0, after = 0;
  for (std::size_t n = 0; n < momentum.size(); ++n) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = b_.velocity[d].row(row[n])[index[n]];
      before += 0.5 * b_.node_mass.row(row[n])[index[n]] * u * u;
    }
  }
  compute_node_mass(b_, *scene_.pool);
  // A node that more passes through than stays may be left with a speed that nothing there had: what is too much of its
  // momentum goes to its heaviest neighbour, or out with an entry where there is none.
  for (std::size_t n = 0; n < met; ++n) {
    const double m = b_.node_mass.row(row[n])[index[n]];
    std::size_t heaviest = n;
    double weight = m;
    for (int q = 0; q < 2 * Dim; ++q) {
      std::array<int, 3> to = place[n];
      const auto a = static_cast<std::size_t>(q / 2);
      to[a] += q % 2 == 0 ? -1 : 1;
      if (to[a] >= 0 && to[a] <= g_.cells[a] && b_.node_mass.row(g_.node_row(to[1], to[2]))[to[0]] > weight) {
        heaviest = entry(to);
        weight = b_.node_mass.row(g_.node_row(to[1], to[2]))[to[0]];
      }
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = m > 0 ? momentum[n][d] / m : 0.0;
      const double kept = m > 0 && least[n][d] <= most[n][d] ? m * std::clamp(u, least[n][d], most[n][d]) : 0.0, excess = momentum[n][d] - kept;
      momentum[n][d] = kept;
      if (heaviest != n) {
        momentum[heaviest][d] += excess;
      } else {
        scene_.ledger.momentum_out[d] += excess;
      }
    }
  }
  for (std::size_t n = 0; n < momentum.size(); ++n) {
    const double m = b_.node_mass.row(row[n])[index[n]];
    for (std::size_t d = 0; d < Dim; ++d) {
      double& u = b_.velocity[d].row(row[n])[index[n]];
      u += m > 0 ? (momentum[n][d] - m * u) / m : 0.0;
      after += 0.5 * m * u * u;
    }
  }
  scene_.ledger.remap_kinetic_loss += before - after;
}

template void EmbeddedRemap<2>::move_momentum();
template void EmbeddedRemap<3>::move_momentum();

} // namespace ballast
