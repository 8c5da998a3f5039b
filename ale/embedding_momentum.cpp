// Momentum goes corner by corner with the mass, at the velocity of the corner it leaves.
#include "ale/embedding_pass.hpp"

namespace ballast {

template <int Dim> void EmbeddedRemap<Dim>::move_momentum() {
  std::vector<std::size_t> nodes;
  std::vector<int> row, index;
  std::vector<int> of(static_cast<std::size_t>(g_.node_pitch()) * static_cast<std::size_t>(g_.node_rows()), -1);
  std::vector<std::array<double, Dim>> momentum, least, most; // of the velocities that meet at a node
  std::vector<std::array<int, 3>> home;                      // a cell that has it as a corner
  const auto corner = [&](std::size_t c, int bits) {
    std::array<int, 3> n = cells_[c];
    for (std::size_t a = 0; a < Dim; ++a) {
      n[a] += bits >> a & 1;
    }
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
      home.push_back(cells_[c]);
    }
    return static_cast<std::size_t>(at_node);
  };
  for (const Transfer& t : transfer_) {
    const auto from = static_cast<std::size_t>(t.from), to = static_cast<std::size_t>(t.to);
    for (int bits = 0; bits < (1 << Dim); ++bits) {
      const std::size_t a = corner(from, bits), z = corner(to, bits);
      const double leaves = t.mass * corner_share(b_, bits, cells_[from][0], cells_[from][1], cells_[from][2]);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double u = b_.velocity[d].row(row[a])[index[a]], p = leaves * u;
        momentum[a][d] -= p;
        momentum[z][d] += p;
        least[z][d] = std::min(least[z][d], u);
        most[z][d] = std::max(most[z][d], u);
      }
    }
  }
  double before = 0, after = 0;
  std::vector<double> mass(momentum.size());
  for (std::size_t n = 0; n < momentum.size(); ++n) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = b_.velocity[d].row(row[n])[index[n]];
      before += 0.5 * b_.node_mass.row(row[n])[index[n]] * u * u;
    }
    mass[n] = b_.node_mass.row(row[n])[index[n]];
  }
  compute_node_mass(b_, *scene_.pool);
  // A node that more passes through than stays may be left with a speed that nothing there had: what is too much of its
  // momentum goes to the heaviest node of a cell it belongs to.
  for (std::size_t n = 0; n < momentum.size(); ++n) {
    const double m = b_.node_mass.row(row[n])[index[n]];
    std::size_t heaviest = n;
    double weight = m;
    for (int bits = 0; bits < (1 << Dim); ++bits) {
      std::array<int, 3> other = home[n];
      for (std::size_t a = 0; a < Dim; ++a) {
        other[a] += bits >> a & 1;
      }
      const int r = g_.node_row(other[1], other[2]), at_node = of[node_at(g_, r, other[0])];
      if (at_node >= 0 && b_.node_mass.row(r)[other[0]] > weight) {
        heaviest = static_cast<std::size_t>(at_node);
        weight = b_.node_mass.row(r)[other[0]];
      }
    }
    for (std::size_t d = 0; d < Dim && heaviest != n; ++d) {
      const double u = m > 0 ? momentum[n][d] / m : 0.0;
      const double kept = m > 0 && least[n][d] <= most[n][d] ? m * std::clamp(u, least[n][d], most[n][d]) : 0.0;
      momentum[heaviest][d] += momentum[n][d] - kept;
      momentum[n][d] = kept;
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
