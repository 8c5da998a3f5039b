#include "ale/layers/layer_load.hpp"

#include "ale/layers/layer_edges.hpp"

#include <Eigen/LU>

namespace ballast {

template <int Dim>
Eigen::Matrix<double, Dim, 1> pushed(double mass, const Eigen::Matrix<double, Dim, Dim>& added, const Eigen::Matrix<double, Dim, 1>& impulse, unsigned held) {
  Eigen::Matrix<double, Dim, Dim> m = added;
  Eigen::Matrix<double, Dim, 1> j = impulse;
  if ((added.array() == 0).all()) { // nothing hangs on it
    for (int d = 0; d < Dim; ++d) {
      j[d] = (held >> d & 1) != 0 ? 0.0 : impulse[d] / mass;
    }
    return j;
  }
  for (int d = 0; d < Dim; ++d) {
    if ((held >> d & 1) != 0) {
      m.row(d).setZero();
      m.col(d).setZero();
      j[d] = 0;
    }
    m(d, d) += mass;
  }
  return m.inverse() * j;
}

template <int Dim> void put_on(LayerStack<Dim>& s, LayerLoad<Dim>& load) {
  const std::vector<unsigned char> held = held_nodes(s);
  load.own.resize(load.node.size());
  for (std::size_t q = 0; q < load.node.size(); ++q) {
    const std::size_t n = load.node[q];
    const unsigned bits = held[n % held.size()];
    typename LayerLoad<Dim>::Vector own;
    for (int d = 0; d < Dim; ++d) {
      own[d] = s.force[static_cast<std::size_t>(d)][n];
    }
    load.own[q] = own;
    const typename LayerLoad<Dim>::Vector all = own + load.force[q], a = pushed<Dim>(s.mass[n], load.added[q], all, bits);
    const typename LayerLoad<Dim>::Vector carried = load.added[q] * a;
    for (int d = 0; d < Dim; ++d) { // what holds a node feels all that it does not hand on to what hangs there
      s.force[static_cast<std::size_t>(d)][n] = (bits >> d & 1) != 0 ? all[d] - carried[d] : s.mass[n] * a[d];
    }
  }
}

template <int Dim> void take_off(LayerStack<Dim>& s, LayerLoad<Dim>& load) {
  for (std::size_t q = 0; q < load.node.size(); ++q) {
    for (int d = 0; d < Dim; ++d) {
      s.force[static_cast<std::size_t>(d)][load.node[q]] = load.own[q][d];
    }
  }
}

template <int Dim> void book_new_force(const LayerStack<Dim>& s, const LayerLoad<Dim>& load, double dt, LayerLedger& ledger) {
  if (!(dt < s.step)) { // the mesh's step, of which the layers may take many
    return;
  }
  const std::vector<unsigned char> held = held_nodes(s);
  for (std::size_t q = 0; q < load.node.size(); ++q) {
    const std::size_t n = load.node[q];
    double more = 0; // squares
    for (std::size_t d = 0; d < Dim; ++d) {
      const double own = load.own[q][static_cast<Eigen::Index>(d)];
      more += (held[n % held.size()] >> d & 1) == 0 ? s.force[d][n] * s.force[d][n] - own * own : 0.0;
    }
    const double change = more > 0 ? 0.125 * (dt * dt - s.step * s.step) * more / s.mass[n] : 0.0; // else it balances the elements' force, as in the step before
    ledger.step_change -= change;
    ledger.load_work -= change;
  }
}

template <int Dim> void book_load(const LayerStack<Dim>& s, const LayerLoad<Dim>& load, double half, LayerLedger& ledger) {
  for (std::size_t q = 0; q < load.node.size(); ++q) {
    for (int d = 0; d < Dim; ++d) {
      const std::vector<double>&f = s.force[static_cast<std::size_t>(d)], &v = s.velocity[static_cast<std::size_t>(d)];
      ledger.load_work += half * (f[load.node[q]] - load.own[q][d]) * v[load.node[q]];
    }
  }
}

template <int Dim> double kinetic_of(const LayerStack<Dim>& s, const LayerLoad<Dim>& load) {
  const std::vector<unsigned char> held = held_nodes(s);
  double sum = 0;
  for (const std::size_t n : load.node) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double v = s.velocity[d][n], half = 0.5 * s.step * s.force[d][n] / s.mass[n];
      const double before = (held[n % held.size()] >> d & 1) == 0 ? half : 0.0;
      sum += 0.5 * s.mass[n] * (v - before) * (v + before);
    }
  }
  return sum;
}

#define BALLAST_INSTANTIATE(D)                                                                                                                          \
  template Eigen::Matrix<double, D, 1> pushed<D>(double, const Eigen::Matrix<double, D, D>&, const Eigen::Matrix<double, D, 1>&, unsigned);             \
  template void put_on<D>(LayerStack<D>&, LayerLoad<D>&);                                                                                               \
  template void take_off<D>(LayerStack<D>&, LayerLoad<D>&);                                                                                             \
  template void book_new_force<D>(const LayerStack<D>&, const LayerLoad<D>&, double, LayerLedger&);                                                      \
  template void book_load<D>(const LayerStack<D>&, const LayerLoad<D>&, double, LayerLedger&);                                                          \
  template double kinetic_of<D>(const LayerStack<D>&, const LayerLoad<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
