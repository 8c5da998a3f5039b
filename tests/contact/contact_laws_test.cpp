// Contact of two sheets of free point masses: momentum, angular momentum, energy, no approach left, nothing along the surface.
#include "sheets.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double speed = 100, dt = 1e-7, side = 0.01; // m/s, s, m

template <int Dim> struct Two {
  Sheet<Dim> low, high;
  ContactState<Dim> state;
  ContactSettings settings;
  ContactReport total, last;

  void step(double by = dt) {
    ContactSurface<Dim> a = low.view(), b = high.view();
    last = resolve_contact(a, b, by, settings, state);
    add_report(total, last);
    low.move(by);
    high.move(by);
  }
  double kinetic_energy() const { return low.kinetic_energy() + high.kinetic_energy(); }
  double largest_momentum() const { return 0.5 * std::abs(speed) * (mass_of(low) + mass_of(high)); }
  static double mass_of(const Sheet<Dim>& s) {
    double m = 0;
    for (const double n : s.mass) {
      m += n;
    }
    return m;
  }
};

/// A lower sheet of n segments and an upper one of m, shifted so that no nodes meet; they fly at each other.
template <int Dim> Two<Dim> flying(int n, int m, double shift) {
  Two<Dim> t;
  t.low = flat_sheet<Dim>(n, 0, side, 0, 1, 1e-3);
  t.high = flat_sheet<Dim>(m, shift, side, 2.4e-5, -1, 2e-3);
  std::array<double, Dim> up{}, down{};
  up[0] = 7;
  up[Dim - 1] = 0.4 * speed;
  down[0] = -11;
  down[Dim - 1] = -0.6 * speed;
  t.low.set_velocity(up);
  t.high.set_velocity(down);
  return t;
}

template <int Dim> void expect_momentum(const Two<Dim>& t, const std::array<double, Dim>& p0, const std::array<double, 3>& l0) {
  const auto pa = t.low.momentum(), pb = t.high.momentum();
  const auto la = t.low.angular_momentum(), lb = t.high.angular_momentum();
  for (std::size_t d = 0; d < Dim; ++d) {
    EXPECT_NEAR(pa[d] + pb[d], p0[d], 1e-13 * t.largest_momentum());
  }
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(la[d] + lb[d], l0[d], 1e-13 * side * t.largest_momentum());
  }
}

template <int Dim> void expect_conserves(Two<Dim> t, int steps) {
  std::array<double, Dim> p0 = t.low.momentum();
  std::array<double, 3> l0 = t.low.angular_momentum();
  for (std::size_t d = 0; d < Dim; ++d) {
    p0[d] += t.high.momentum()[d];
  }
  for (std::size_t d = 0; d < 3; ++d) {
    l0[d] += t.high.angular_momentum()[d];
  }
  double energy = t.kinetic_energy();
  for (int n = 0; n < steps; ++n) {
    t.step();
    EXPECT_GE(t.last.loss, -1e-15 * energy);
    const double now = t.kinetic_energy();
    EXPECT_NEAR(energy - now, t.last.loss, 1e-13 * energy); // the report's loss is the loss
    EXPECT_LE(now, energy * (1 + 1e-15));
    energy = now;
    expect_momentum<Dim>(t, p0, l0);
  }
  EXPECT_GT(t.total.active, 0);
}

// Momentum and angular momentum to round-off (1e-13), energy never gained: matched and not, flat, turned, curved.
TEST(Contact, ConservesMomentumAndNeverGainsEnergy) {
  for (const auto& [n, m, shift] : {std::tuple(6, 6, 0.0), std::tuple(6, 6, 0.0007), std::tuple(10, 27, 0.0003)}) {
    expect_conserves(flying<2>(n, m, shift), 12);
    expect_conserves(flying<3>(n, m, shift), 12);
    for (const double angle : {0.3, 1.1, 2.9}) {
      Two<2> a = flying<2>(n, m, shift);
      Two<3> b = flying<3>(n, m, shift);
      for (auto* s : {&a.low, &a.high}) {
        turn<2>(s->x, angle);
        turn<2>(s->v, angle);
      }
      for (auto* s : {&b.low, &b.high}) {
        turn<3>(s->x, angle);
        turn<3>(s->v, angle);
      }
      expect_conserves(std::move(a), 12);
      expect_conserves(std::move(b), 12);
    }
  }
}

/// Scattered velocities and a warped lower sheet: every impulse has its own direction.
template <int Dim> Two<Dim> warped(int n, int m) {
  Two<Dim> t = flying<Dim>(n, m, 0.0004);
  for (auto* s : {&t.low, &t.high}) {
    for (std::size_t i = 0; i < s->mass.size(); ++i) {
      s->x[Dim - 1][i] += 4e-4 * std::sin(400 * s->x[0][i]) * (Dim == 3 ? std::cos(300 * s->x[1][i]) : 1);
      for (std::size_t d = 0; d < Dim; ++d) {
        s->v[d][i] += 20 * scatter(i * Dim + d);
      }
    }
  }
  return t;
}

TEST(Contact, ConservesOnWarpedSheets) {
  expect_conserves(warped<2>(12, 31), 20);
  expect_conserves(warped<3>(7, 18), 20);
}

// Sheets without stiffness that fly at each other: what is left is the common velocity of masses that have joined.
TEST(Contact, StopsTheApproachOfMatchedSheets) {
  Two<3> t = flying<3>(5, 5, 0);
  t.low.set_velocity({7, 0, 0.4 * speed});
  t.high.set_velocity({7, 0, -0.6 * speed});
  for (int n = 0; n < 6; ++n) {
    t.step();
  }
  const double common = (1e-3 * 0.4 - 2e-3 * 0.6) / 3e-3 * speed;
  for (const Sheet<3>* s : {&t.low, &t.high}) {
    for (std::size_t n = 0; n < s->mass.size(); ++n) {
      EXPECT_NEAR(s->v[0][n], 7, 1e-14 * speed);
      EXPECT_NEAR(s->v[1][n], 0, 1e-14 * speed);
      EXPECT_NEAR(s->v[2][n], common, 1e-13 * speed);
    }
  }
}

template <int Dim> double left_over(int n, int m) {
  Two<Dim> t = flying<Dim>(n, m, 0); // the same corners
  std::array<double, Dim> up{}, down{};
  up[Dim - 1] = 0.4 * speed;
  down[Dim - 1] = -0.6 * speed;
  t.low.set_velocity(up);
  t.high.set_velocity(down);
  for (int k = 0; k < 8; ++k) {
    t.step();
  }
  EXPECT_LT(t.last.deepest, 1e-3 * dt * speed);
  double worst = 0; // approach left at any foot
  ContactSurface<Dim> a = t.low.view(), b = t.high.view();
  for (std::size_t s = 0; s < 2; ++s) {
    const ContactTrack<Dim>& track = t.state.tracks[s];
    for (std::size_t k = 0; k < track.gap.size(); ++k) {
      const auto u = relative_velocity<Dim>(s == 0 ? a : b, static_cast<int>(k), s == 0 ? b : a, track.segment[k], track.local[k]);
      double opening = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        opening += u[d] * track.normal[d][k];
      }
      worst = std::max(worst, -opening);
    }
  }
  return worst / speed;
}

TEST(Contact, StopsTheApproachWhateverTheSpacing) {
  EXPECT_LT(left_over<2>(10, 10), 1e-12);
  EXPECT_LT(left_over<2>(10, 27), 1e-3); // tolerance 1e-4 of what each step finds
  EXPECT_LT(left_over<3>(8, 8), 1e-12);
  EXPECT_LT(left_over<3>(6, 16), 1e-3);
}

// Frictionless: in the step in which flat sheets meet nothing changes along them.
TEST(Contact, LeavesVelocityAlongTheSurfaceAlone) {
  for (const int m : {6, 16}) {
    Two<3> t = flying<3>(6, m, 0.0003);
    while (t.total.active == 0) {
      t.step();
    }
    EXPECT_GT(t.last.loss, 0);
    for (std::size_t n = 0; n < t.low.mass.size(); ++n) {
      EXPECT_NEAR(t.low.v[0][n], 7, 1e-14 * speed);
      EXPECT_NEAR(t.low.v[1][n], 0, 1e-14 * speed);
    }
    for (std::size_t n = 0; n < t.high.mass.size(); ++n) {
      EXPECT_NEAR(t.high.v[0][n], -11, 1e-14 * speed);
      EXPECT_NEAR(t.high.v[1][n], 0, 1e-14 * speed);
    }
  }
}

// Sheets that touch and rest stay as they are, to the bit; so do sheets that rest a little inside each other.
TEST(Contact, TouchingSheetsRest) {
  for (const double gap : {0.0, -1e-9, 1e-9}) {
    Two<3> t = flying<3>(6, 13, 0.0003);
    t.high = flat_sheet<3>(13, 0.0003, side, gap, -1, 2e-3);
    t.low.set_velocity({0, 0, 0});
    const auto x = t.high.x;
    for (int k = 0; k < 5; ++k) {
      t.step();
    }
    EXPECT_EQ(t.high.x, x);
    for (std::size_t d = 0; d < 3; ++d) {
      for (const double v : t.low.v[d]) {
        EXPECT_EQ(v, 0);
      }
    }
    EXPECT_NEAR(t.last.deepest, std::max(-gap, 0.0), 1e-18);
  }
}

// A penetration is pushed out while two rigid sheets are pressed together, and no step gains energy.
TEST(Contact, PushesPenetrationOutWithoutGain) {
  Two<2> t = flying<2>(10, 27, 0.0003);
  t.high = flat_sheet<2>(27, 0.0003, side, -2e-5, -1, 2e-3);
  t.low.set_velocity({0, 0});
  double deepest = 2e-5;
  for (int k = 0; k < 600; ++k) {
    for (double& v : t.high.v[1]) {
      v -= 1; // pressed: 1e7 m/s2
    }
    ContactSurface<2> a = t.low.view(), b = t.high.view();
    const ContactReport report = resolve_contact(a, b, dt, t.settings, t.state);
    EXPECT_GE(report.loss, -1e-18);
    EXPECT_LE(report.deepest, deepest + 1e-3 * dt * 1); // of what a step would come closer: sweeps end at 1e-4
    deepest = report.deepest;
    for (Sheet<2>* s : {&t.low, &t.high}) {
      s->set_velocity({0, s->momentum()[1] / Two<2>::mass_of(*s)});
      s->move(dt);
    }
  }
  EXPECT_LT(deepest, 2e-7);
}

// Two rigid sheets inside each other are pressed from rest: contact has taken no energy yet, so it gives none, and keeps them
// where they are.
TEST(Contact, GivesBackNoMoreThanItTook) {
  Two<2> t = flying<2>(10, 10, 0);
  t.high = flat_sheet<2>(10, 0, side, -2e-5, -1, 2e-3);
  t.low.set_velocity({0, 0});
  std::vector<double> none(t.low.mass.size(), 0.0), press, zero(t.high.mass.size(), 0.0);
  for (const double m : t.high.mass) {
    press.push_back(-1e7 * m);
  }
  double taken = 0;
  for (int k = 0; k < 100; ++k) {
    for (double& v : t.high.v[1]) {
      v -= 1e7 * dt;
    }
    ContactSurface<2> a = t.low.view(), b = t.high.view();
    a.force = {none.data(), none.data()};
    b.force = {zero.data(), press.data()};
    const ContactReport report = resolve_contact(a, b, dt, t.settings, t.state);
    taken += report.loss;
    EXPECT_GE(taken, -1e-13); // a push of one step would take about 1e-3 J
    EXPECT_NEAR(report.deepest, 2e-5, 1e-12);
    for (Sheet<2>* s : {&t.low, &t.high}) {
      s->set_velocity({0, s->momentum()[1] / Two<2>::mass_of(*s)});
      s->move(dt);
    }
  }
}

// Axes r, z: masses of rings, impulses of rings. Annular sheets with one speed each end with the common one, like plane ones.
TEST(Contact, RingsKeepAxialMomentum) {
  Two<2> t;
  t.low = flat_sheet<2>(10, 0.002, side, 0, 1, 1e-3);
  t.high = flat_sheet<2>(10, 0.002, side, 2.4e-5, -1, 2e-3);
  for (auto* s : {&t.low, &t.high}) {
    for (std::size_t n = 0; n < s->mass.size(); ++n) {
      s->mass[n] *= 6.283 * s->x[0][n];
    }
  }
  t.low.set_velocity({0, 0.4 * speed});
  t.high.set_velocity({0, -0.6 * speed});
  const double p0 = t.low.momentum()[1] + t.high.momentum()[1], e0 = t.kinetic_energy();
  for (int k = 0; k < 6; ++k) {
    t.step();
  }
  EXPECT_NEAR(t.low.momentum()[1] + t.high.momentum()[1], p0, 1e-13 * std::abs(p0));
  EXPECT_NEAR(t.kinetic_energy() + t.total.loss, e0, 1e-13 * e0);
  for (const double v : t.low.v[1]) {
    EXPECT_NEAR(v, -0.8 / 3 * speed, 1e-10 * speed);
  }
}

// A node on a plane of symmetry gets no velocity across it; the plane takes the impulse.
TEST(Contact, HeldNodesPassTheImpulseOn) {
  Two<2> t = warped<2>(12, 31);
  std::vector<unsigned char> low_held(t.low.mass.size(), 0), high_held(t.high.mass.size(), 0);
  low_held[3] = 1;
  high_held[9] = 3;
  t.low.v[0][3] = 0;
  t.high.v[0][9] = t.high.v[1][9] = 0;
  const auto pa = t.low.momentum(), pb = t.high.momentum();
  std::array<double, 2> given{};
  for (int k = 0; k < 12; ++k) {
    ContactSurface<2> a = t.low.view(), b = t.high.view();
    a.held = low_held.data();
    b.held = high_held.data();
    const ContactReport r = resolve_contact(a, b, dt, t.settings, t.state);
    given[0] += r.impulse_sum[0];
    given[1] += r.impulse_sum[1];
    t.low.move(dt);
    t.high.move(dt);
  }
  EXPECT_EQ(t.low.v[0][3], 0);
  EXPECT_EQ(t.high.v[0][9], 0);
  EXPECT_EQ(t.high.v[1][9], 0);
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_NEAR(t.low.momentum()[d] + t.high.momentum()[d], pa[d] + pb[d] + given[d], 1e-13 * t.largest_momentum());
  }
  EXPECT_GT(std::abs(given[1]), 1e-6);
}

} // namespace
} // namespace ballast
