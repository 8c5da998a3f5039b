// The layers' energy account with contact: pressed surfaces lose nothing, steps of any size, contact and edges together.
#include "ale/layers/slideline.hpp"
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace stacks;

/// A flat plate that nothing moves from its way, across a strip.
struct Plate {
  Plate(double width, double level, int turned) : outside(turned) {
    position = {std::vector<double>{-width, 2 * width}, std::vector<double>{level, level}};
    velocity = {std::vector<double>{0, 0}, std::vector<double>{0, 0}};
  }
  ContactSurface<2> surface() {
    ContactSurface<2> s;
    s.segments = {1, 1};
    for (std::size_t d = 0; d < 2; ++d) {
      s.position[d] = position[d].data();
      s.velocity[d] = velocity[d].data();
      s.velocity_n[d] = velocity[d].data();
    }
    s.mass = mass.data();
    s.held = held.data();
    s.outside = outside;
    return s;
  }
  std::array<std::vector<double>, 2> position, velocity;
  std::vector<double> mass = {1, 1};
  std::vector<unsigned char> held = {3, 3};
  int outside;
  ContactState<2> state;
};

struct Press {
  double internal, held, strain, loss, work, kinetic, height; ///< J a metre of depth; m
};

/// A stack of `layers` pressed from both sides by `share` of its height within many passages of a wave, then left between the plates at rest.
Press press(const FabricModel& model, int layers, double share, double step_swing) {
  constexpr double width = 1e-3, height = 2e-3;
  LayerInput in = brick(model, {2, 1, layers}, {0.5 * width, 1, height / layers}, 2);
  in.edge[0] = {LayerEdge::symmetry, LayerEdge::symmetry};
  in.viscosity = {0, 0};
  LayerStack<2> s = make_stack<2>(in);
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  SlidelineState<2> state;
  const std::vector<unsigned char> held = held_nodes(s);
  std::array<Plate, 2> plates = {Plate(width, 0, 1), Plate(width, height, -1)};
  const double whole = 400e-6, ramp = 0.8 * whole, fastest = share * height / ramp; // each plate goes half: mean of sin^2
  double time = 0, work = 0;
  for (long step = 0; time < whole; ++step) {
    const double dt = stable_step(s).dt * (1 - step_swing * static_cast<double>(step * 7 % 10) / 10);
    substep(s, dt, ledger, pool, [&] {
      resolve_slidelines(s, dt, s.velocity, pool, {}, state);
      for (std::size_t p = 0; p < 2; ++p) {
        const double before = plates[p].velocity[1][0], phase = std::sin(std::numbers::pi * (time + 0.5 * dt) / ramp);
        const double speed = time < ramp ? (p == 0 ? 1 : -1) * fastest * phase * phase : 0.0;
        plates[p].velocity[1] = {speed, speed};
        ContactSurface<2> plate = plates[p].surface(), layer = layer_surface(s, s.velocity, p == 0 ? 0 : layers - 1, p == 1, held);
        work += 0.5 * (before + speed) * resolve_contact(plate, layer, dt, {}, plates[p].state).impulse_sum[1];
      }
    });
    for (Plate& plate : plates) {
      for (double& y : plate.position[1]) {
        y += dt * plate.velocity[1][0];
      }
    }
    time += dt;
  }
  const LayerTotals t = totals(s);
  const Stored stored = stored_energy(s);
  EXPECT_NEAR(total_energy(s, ledger), 0, 1e-12 * t.internal);
  return {t.internal, t.hourglass + t.shock_heat, stored.strain, ledger.contact_loss + work, work, t.leapfrog_kinetic, plates[1].position[1][0] - plates[0].position[1][0]};
}

// What the plates give is strain energy and contact takes nothing, at even steps and at steps between half and the whole of the stable one.
TEST(LayerAccount, PressedStacksLoseNothing) {
  for (const FabricModel& model : {FabricModel{hooke(5e9, 0.2, 1440)}, FabricModel{fabric_laws::paper()}}) {
    const bool printed = model.index() == 0;
    for (const double step_swing : {0.0, 0.5}) {
      const Press p = press(model, 5, printed ? 0.3 : 0.1, step_swing);
      EXPECT_NEAR(p.height, 2e-3 * (printed ? 0.7 : 0.9), 1e-5);
      EXPECT_NEAR(p.internal / p.strain, 1, 1e-6) << printed << ' ' << step_swing;
      EXPECT_NEAR(p.work / p.strain, 1, 1e-6) << printed << ' ' << step_swing;
      EXPECT_NEAR(p.loss, 0, 1e-9 * p.strain) << printed << ' ' << step_swing;
      EXPECT_NEAR(p.held, 0, 1e-6 * p.strain);
      EXPECT_LT(p.kinetic, 1e-3 * p.strain);
    }
  }
}

/// Layers that run into each other and slide, edges held or elastic, steps from a tenth to the whole of the stable one.
template <int Dim> void expect_exact(const FabricModel& model, LayerEdge edge, bool ring) {
  LayerInput in = brick(model, {8, 4, 4}, {1e-3, 1e-3, 0.5e-3}, Dim);
  in.axisymmetric = ring;
  in.edge[0] = {LayerEdge::symmetry, edge};
  in.edge_stiffness = edge == LayerEdge::elastic ? 1e9 : 0;
  LayerStack<Dim> s = make_stack<Dim>(in);
  place(s, s.velocity, [&](std::array<double, Dim> X) {
    std::array<double, Dim> v = {};
    v[0] = 10 * std::sin(800 * X[0]);
    v[Dim - 1] = 50 - 6e4 * X[Dim - 1] + 20 * std::sin(1500 * X[0]);
    return v;
  });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double kinetic = totals(s).kinetic, energy = total_energy(s, ledger);
  EXPECT_NEAR(totals(s).leapfrog_kinetic, kinetic, 1e-14 * kinetic); // no step yet
  SlidelineState<Dim> state;
  ContactSettings settings;
  settings.friction = 0.2;
  double unaccounted = 0, largest_change = 0;
  for (int step = 0; step < 300; ++step) {
    const double dt = stable_step(s).dt * (0.1 + 0.9 * static_cast<double>(step * 37 % 100) / 100);
    substep(s, dt, ledger, pool, [&] { resolve_slidelines(s, dt, s.velocity, pool, settings, state); });
    unaccounted = std::max(unaccounted, std::abs(total_energy(s, ledger) - energy));
    largest_change = std::max(largest_change, std::abs(ledger.step_change));
  }
  EXPECT_LT(unaccounted, 1e-12 * kinetic);
  EXPECT_GT(largest_change, 1e-6 * kinetic);
  EXPECT_GT(ledger.contact_loss, 1e-3 * kinetic);
}

TEST(LayerAccount, IsExactForAnySteps) {
  for (const LayerEdge edge : {LayerEdge::free, LayerEdge::fixed, LayerEdge::elastic}) {
    expect_exact<2>(hooke(5e9, 0.2, 1440), edge, false);
    expect_exact<2>(fabric_laws::paper(), edge, true);
    expect_exact<3>(fabric_laws::paper(), edge, false);
  }
}

// Two halves run into each other: the layers' account finds what contact's own report says, also where the step changes.
TEST(LayerAccount, LossIsThatOfTheContactReports) {
  LayerStack<2> s = make_stack<2>(brick(hooke(5e9, 0.2, 1440), {8, 1, 4}, {1e-3, 1e-3, 0.5e-3}, 2));
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    s.velocity[1][n] = n < s.node_count() / 2 ? 50 : -50;
  }
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double kinetic = totals(s).kinetic;
  SlidelineState<2> state;
  double reported = 0;
  for (int step = 0; step < 200; ++step) {
    const double dt = stable_step(s).dt * (step % 50 < 25 ? 0.9 : 1);
    substep(s, dt, ledger, pool, [&] { reported += resolve_slidelines(s, dt, s.velocity, pool, {}, state).contact.loss; });
  }
  EXPECT_NEAR(ledger.contact_loss, 0.25 * kinetic, 1e-4 * kinetic); // two of eight planes stop
  EXPECT_NEAR(ledger.contact_loss, reported, 1e-12 * kinetic);
}

// A printed-law ring that is thrown at the axis: nothing resists but the axis, elements stay right side out and the account exact.
TEST(LayerAccount, RingsStopAtTheAxis) {
  LayerInput in = brick(fabric_laws::paper(), {8, 1, 2}, {1e-3, 1, 0.5e-3}, 2);
  in.axisymmetric = true;
  in.edge[0] = {LayerEdge::symmetry, LayerEdge::free};
  in.guard = {0, 0}; // they would stop it before
  LayerStack<2> s = make_stack<2>(in);
  place(s, s.velocity, [](std::array<double, 2> X) -> std::array<double, 2> { return {X[0] > 0 ? -100.0 : 0.0, 0}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double energy = total_energy(s, ledger);
  double time = 0, least = 1;
  while (time < 30e-6) {
    const double dt = stable_step(s).dt;
    substep(s, dt, ledger, pool);
    time += dt;
    for (std::size_t n = 0; n < s.node_count(); ++n) {
      least = std::min(least, s.rest[0][n] > 0 ? s.position[0][n] / s.rest[0][n] : 1.0);
    }
  }
  EXPECT_GT(least, 0.0099);
  EXPECT_LT(least, 0.011);
  EXPECT_GT(ledger.contact_loss, 0.1 * energy);
  EXPECT_NEAR(total_energy(s, ledger), energy, 1e-12 * energy);
}

} // namespace
} // namespace ballast
