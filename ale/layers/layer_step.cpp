#include "ale/layers/layer_step.hpp"

#include "ale/layers/layer_account.hpp"
#include "ale/layers/layer_edges.hpp"
#include "ale/layers/layer_folds.hpp"

#include <algorithm>
#include <limits>

namespace ballast {
namespace {

constexpr double least_radius = 0.01; ///< of that at rest: a ring that closes has met itself

template <int Dim> void accelerate(LayerStack<Dim>& s, double half, ThreadPool& pool) {
  parallel_ranges(pool, static_cast<int>(s.node_count()), [&](int begin, int end, int) {
    const double* mass = s.mass.data();
    for (std::size_t d = 0; d < Dim; ++d) {
      double* v = s.velocity[d].data();
      const double* f = s.force[d].data();
#pragma omp simd
      for (int n = begin; n < end; ++n) {
        v[n] += half * f[n] / mass[n];
      }
    }
  });
}

} // namespace

template <int Dim> LayerTimestep stable_step(const LayerStack<Dim>& s, double cfl) {
  LayerTimestep least{std::numeric_limits<double>::infinity()};
  for (std::size_t e = 0; e < s.element_count(); ++e) {
    if (!(s.wave_step[e] >= least.dt)) { // what is no number, too
      least.dt = s.wave_step[e];
      least.element = e;
    }
  }
  const auto n1 = static_cast<std::size_t>(s.grid.elements[0]), n2 = static_cast<std::size_t>(s.grid.elements[1]);
  least.i = static_cast<int>(least.element % n1);
  least.j = static_cast<int>(least.element / n1 % n2);
  least.level = static_cast<int>(least.element / (n1 * n2));
  least.dt *= cfl;
  return least;
}

template <int Dim> void kick(LayerStack<Dim>& s, double half, LayerLedger& ledger, ThreadPool& pool) {
  accelerate(s, half, pool);
  hold_edges(s, half, ledger);
}

template <int Dim> void drift(LayerStack<Dim>& s, double dt, ThreadPool& pool) {
  parallel_ranges(pool, static_cast<int>(s.node_count()), [&](int begin, int end, int) {
    for (std::size_t d = 0; d < Dim; ++d) {
      double* x = s.position[d].data();
      const double* v = s.velocity[d].data();
#pragma omp simd
      for (int n = begin; n < end; ++n) {
        x[n] += dt * v[n];
      }
    }
  });
}

template <int Dim> void stop_at_axis(LayerStack<Dim>& s, double dt) {
  if (!s.axisymmetric) {
    return;
  }
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    const double least = least_radius * s.rest[0][n], r = s.position[0][n];
    double& v = s.velocity[0][n];
    if (v < 0 && r + dt * v < least) {
      v = std::min(0.0, (least - r) / dt);
    }
  }
}

template <int Dim> void begin_substep(LayerStack<Dim>& s, double dt, LayerLedger& ledger, ThreadPool& pool, LayerLoad<Dim>* load) {
  kick(s, dt / 2, ledger, pool);
  keep_velocity(s);
  stop_folds<Dim>(s, dt, held_nodes(s), ledger, pool, load);
}

template <int Dim> void end_substep(LayerStack<Dim>& s, double dt, LayerLedger& ledger, ThreadPool& pool, LayerLoad<Dim>* load) {
  stop_at_axis(s, dt);
  book_contact(s, dt, ledger, pool);
  book_work(s, dt / 2, ledger, pool);
  if (load != nullptr) {
    book_load(s, *load, dt / 2, ledger);
  }
  drift(s, dt, pool);
  update_forces(s, dt, ledger, pool);
  if (load != nullptr) {
    put_on(s, *load);
    book_load(s, *load, dt / 2, ledger);
  }
  book_work(s, dt / 2, ledger, pool);
  kick(s, dt / 2, ledger, pool);
  s.step = dt;
}

template <int Dim> void substep(LayerStack<Dim>& s, double dt, LayerLedger& ledger, ThreadPool& pool, const std::function<void()>& contact, LayerLoad<Dim>* load) {
  begin_substep(s, dt, ledger, pool, load);
  if (contact) {
    contact();
  }
  end_substep(s, dt, ledger, pool, load);
}

template <int Dim> LayerTotals totals(const LayerStack<Dim>& s) {
  LayerTotals t;
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    std::array<double, 3> x = {}, v = {};
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = s.position[d][n], v[d] = s.velocity[d][n];
    }
    if (s.axisymmetric) {
      x = {0, 0, 0};
    }
    const double m = s.mass[n];
    t.mass += m;
    t.kinetic += 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (std::size_t d = s.axisymmetric ? 1 : 0; d < 3; ++d) {
      t.momentum[d] += m * v[d];
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t a = (d + 1) % 3, b = (d + 2) % 3;
      t.angular_momentum[d] += m * (x[a] * v[b] - x[b] * v[a]);
    }
  }
  t.leapfrog_kinetic = leapfrog_kinetic(s);
  for (std::size_t e = 0; e < s.element_count(); ++e) {
    t.internal += s.energy[e];
    t.hourglass += s.hourglass_energy[e];
    t.shock_heat += s.shock_heat[e];
  }
  return t;
}

template LayerTimestep stable_step<2>(const LayerStack<2>&, double);
template LayerTimestep stable_step<3>(const LayerStack<3>&, double);
template void kick<2>(LayerStack<2>&, double, LayerLedger&, ThreadPool&);
template void kick<3>(LayerStack<3>&, double, LayerLedger&, ThreadPool&);
template void drift<2>(LayerStack<2>&, double, ThreadPool&);
template void drift<3>(LayerStack<3>&, double, ThreadPool&);
template void stop_at_axis<2>(LayerStack<2>&, double);
template void stop_at_axis<3>(LayerStack<3>&, double);
template void begin_substep<2>(LayerStack<2>&, double, LayerLedger&, ThreadPool&, LayerLoad<2>*);
template void end_substep<2>(LayerStack<2>&, double, LayerLedger&, ThreadPool&, LayerLoad<2>*);
template void substep<2>(LayerStack<2>&, double, LayerLedger&, ThreadPool&, const std::function<void()>&, LayerLoad<2>*);
template void begin_substep<3>(LayerStack<3>&, double, LayerLedger&, ThreadPool&, LayerLoad<3>*);
template void end_substep<3>(LayerStack<3>&, double, LayerLedger&, ThreadPool&, LayerLoad<3>*);
template void substep<3>(LayerStack<3>&, double, LayerLedger&, ThreadPool&, const std::function<void()>&, LayerLoad<3>*);
template LayerTotals totals<2>(const LayerStack<2>&);
template LayerTotals totals<3>(const LayerStack<3>&);

} // namespace ballast
