// Contact along a path: curved surfaces, sliding far, parting and meeting again, edges and holes, approach from afar.
#include "sheets.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace ballast {
namespace {

constexpr double dt = 1e-7; // s

/// A floor that nothing moves, and a sheet of free masses.
template <int Dim> struct OnFloor {
  Sheet<Dim> floor, sheet;
  std::vector<unsigned char> fixed;
  ContactState<Dim> state;
  ContactSettings settings;
  double deepest = 0;
  long active = 0;

  ContactReport step() {
    fixed.assign(floor.mass.size(), static_cast<unsigned char>((1 << Dim) - 1));
    ContactSurface<Dim> a = floor.view(), b = sheet.view();
    a.held = fixed.data();
    const ContactReport report = resolve_contact(a, b, dt, settings, state);
    sheet.move(dt);
    deepest = std::max(deepest, report.deepest);
    active += report.active;
    return report;
  }
  /// The sheet as a rigid body without rotation.
  void stiffen() {
    double mass = 0;
    for (const double m : sheet.mass) {
      mass += m;
    }
    auto v = sheet.momentum();
    for (double& c : v) {
      c /= mass;
    }
    sheet.set_velocity(v);
  }
};

// A sphere's cap falls on a plane: nodes stop on the plane, one ring after the other; contact radius sqrt(2 R s) at a fall of s.
TEST(ContactPath, CapFlattensOnPlane) {
  constexpr double radius = 0.05, speed = 100, side = 0.02;
  OnFloor<3> t;
  t.floor = flat_sheet<3>(54, -0.6 * side, 1.2 * side, 0, 1, 1);
  t.sheet = make_sheet<3>({20, 20}, -1, 1e-3, [&](double a, double b) {
    const double x = side * (a - 0.5), y = side * (b - 0.5);
    return std::array<double, 3>{x, y, 1e-6 + radius - std::sqrt(radius * radius - x * x - y * y)};
  });
  t.sheet.set_velocity({0, 0, -speed});
  for (int k = 0; k < 50; ++k) { // falls by 0.5 mm
    t.step();
  }
  EXPECT_LT(t.deepest, 1e-3 * dt * speed);
  const double fall = 50 * dt * speed, contact = std::sqrt(2 * radius * fall), spacing = side / 20;
  for (std::size_t n = 0; n < t.sheet.mass.size(); ++n) {
    const double r = std::hypot(t.sheet.x[0][n], t.sheet.x[1][n]);
    if (r < contact - spacing) {
      EXPECT_GE(t.sheet.x[2][n], -1e-3 * dt * speed);
      EXPECT_LE(t.sheet.x[2][n], 0.1 * spacing); // the floor's nodes lift the chords between free masses that have stopped
      EXPECT_LE(std::abs(t.sheet.v[2][n]), 0.15 * speed);
    } else if (r > contact + spacing) {
      EXPECT_EQ(t.sheet.v[2][n], -speed);
    }
  }
}

/// The segment with the nearest foot, looked for among all.
template <int Dim> int nearest_segment(const ContactSurface<Dim>& nodes, int node, const ContactSurface<Dim>& other) {
  int best = -1;
  double gap = 1;
  for (int e = 0; e < other.segment_count(); ++e) {
    const Foot<Dim> foot = find_foot<Dim>(other, e, nodes.place(node), {0.5, 0.5});
    const auto in = [](double a) { return a >= -1e-9 && a <= 1 + 1e-9; };
    if (foot.found && in(foot.local[0]) && (Dim == 2 || in(foot.local[1])) && std::abs(foot.gap) < gap) {
      gap = std::abs(foot.gap);
      best = e;
    }
  }
  return best;
}

/// A rigid sheet is pressed on waves and slides over them, `by` segments a step.
template <int Dim> void slides(double by) {
  constexpr double spacing = 1e-3, height = 2e-4;
  const double speed = by * spacing / dt;
  OnFloor<Dim> t;
  const auto wave = [&](double x) { return height * std::sin(2 * std::numbers::pi * x / (12 * spacing)); };
  const auto place = [&](double x, double y, double lift) {
    std::array<double, Dim> at{};
    at[0] = x;
    at[1] = y;
    at[Dim - 1] = wave(x) + lift;
    return at;
  };
  t.floor = make_sheet<Dim>({60, 8}, 1, 1, [&](double a, double b) { return place(60 * spacing * a, 8 * spacing * b, 0); });
  t.sheet = make_sheet<Dim>({3, 3}, -1, 1e-3, [&](double a, double b) { return place(2.3 * spacing + 2 * spacing * a, 2.1 * spacing + 2 * spacing * b, 0); });
  for (double& z : t.sheet.x[Dim - 1]) {
    z = height; // flat
  }
  std::array<double, Dim> v{};
  v[0] = speed;
  std::set<int> visited;
  long left = 0;
  const int steps = static_cast<int>(35 / by);
  for (int k = 0; k < steps; ++k) {
    v[Dim - 1] = -0.05 * speed;
    t.sheet.set_velocity(v);
    t.step();
    visited.insert(t.state.tracks[1].segment[0]);
    for (const FootStatus status : t.state.tracks[1].status) {
      left += status != FootStatus::front;
    }
    if (k % 7 == 0) {
      ContactSurface<Dim> floor = t.floor.view();
      // The track is that of the step's start.
      Sheet<Dim> start = t.sheet;
      start.move(-dt);
      EXPECT_EQ(t.state.tracks[1].segment[1], nearest_segment<Dim>(start.view(), 1, floor));
    }
    t.stiffen();
  }
  EXPECT_EQ(left, 0);
  EXPECT_GE(visited.size(), std::min<std::size_t>(20, static_cast<std::size_t>(steps - 2)));
}

TEST(ContactPath, FeetFollowOverManySegments) {
  for (const double by : {0.02, 0.3, 3.3}) { // of a segment a step
    slides<2>(by);
    slides<3>(by);
  }
}

// A convex floor: a node that slides along it fast leaves no more than the second-order error of a step, (dt v)^2 / 8R.
TEST(ContactPath, SlidingOverACurveStaysOutside) {
  constexpr double radius = 0.02, speed = 200;
  OnFloor<2> t;
  t.floor = make_sheet<2>({40, 1}, -1, 1, [&](double a, double) { // a bowl seen from its inside: nodes are pressed on by their own motion
    const double angle = std::numbers::pi * (a - 0.5);
    return std::array<double, 2>{-radius * std::sin(angle), -radius * std::cos(angle)};
  });
  t.sheet = make_sheet<2>({1, 1}, -1, 1e-3, [&](double a, double) { return std::array<double, 2>{0.0002 * (a - 0.5), -0.9 * radius}; });
  t.sheet.set_velocity({speed, -0.3 * speed});
  double energy = t.sheet.kinetic_energy();
  for (int k = 0; k < 1000; ++k) {
    t.step();
    EXPECT_LE(t.sheet.kinetic_energy(), energy * (1 + 1e-14));
    energy = t.sheet.kinetic_energy();
  }
  EXPECT_GT(t.active, 20); // at kinks
  EXPECT_LT(t.deepest, dt * speed * 0.2); // kinks of 4.5 degrees are crossed in a step at most: sin(4.5) = 0.08
  EXPECT_GT(energy, 0.5 * 1e-3 * speed * speed * 0.7);
}

// They part without tension, and meet again at another place, after being too far for any foot.
TEST(ContactPath, PartsAndMeetsAgain) {
  constexpr double speed = 300;
  OnFloor<3> t;
  t.floor = flat_sheet<3>(40, 0, 0.04, 0, 1, 1);
  t.sheet = flat_sheet<3>(4, 0.0052, 0.004, 0, -1, 1e-3);
  t.sheet.set_velocity({0, 0, -1});
  t.step();
  EXPECT_GT(t.active, 0);
  t.sheet.set_velocity({speed, 0.5 * speed, 0.6 * speed});
  const auto v = t.sheet.v;
  t.active = 0;
  for (int k = 0; k < 400; ++k) { // 7 mm up, 12 mm along
    t.step();
  }
  EXPECT_EQ(t.sheet.v, v);
  EXPECT_EQ(t.active, 0);
  t.sheet.set_velocity({0, 0, -speed});
  for (int k = 0; k < 300; ++k) {
    t.step();
  }
  EXPECT_LT(t.deepest, 1e-3 * dt * speed);
  for (std::size_t n = 0; n < t.sheet.mass.size(); ++n) {
    EXPECT_NEAR(t.sheet.x[2][n], 0, 1e-3 * dt * speed);
    EXPECT_NEAR(t.sheet.v[2][n], 0, 1e-4 * speed);
  }
}

// However far a step goes: a node on the known side stops on the surface.
TEST(ContactPath, NothingTunnels) {
  for (const double by : {0.1, 1.0, 10.0, 1000.0}) { // of a segment, in a step
    OnFloor<3> t;
    t.floor = flat_sheet<3>(10, 0, 0.01, 0, 1, 1);
    t.sheet = flat_sheet<3>(4, 0.0022, 0.004, 1e-5, -1, 1e-3);
    t.sheet.set_velocity({0, 0, -by * 1e-3 / dt});
    t.step();
    t.step();
    for (const double z : t.sheet.x[2]) {
      EXPECT_NEAR(z, 0, 1e-3 * by * 1e-3); // of the way: sweeps end at 1e-4
    }
  }
}

// Nodes over eroded segments go through; under the sheet they are behind it and touch nothing, until they come back.
TEST(ContactPath, HolesLetNodesThrough) {
  OnFloor<3> t;
  t.floor = flat_sheet<3>(12, 0, 0.012, 0, 1, 1);
  t.floor.alive.assign(144, 1);
  for (int j = 3; j < 9; ++j) {
    for (int i = 3; i < 9; ++i) {
      t.floor.alive[static_cast<std::size_t>(j * 12 + i)] = 0;
    }
  }
  t.sheet = flat_sheet<3>(2, 0.005, 0.002, 2e-4, -1, 1e-3);
  t.sheet.set_velocity({0, 0, -100});
  for (int k = 0; k < 100; ++k) { // to 0.8 mm below
    t.step();
  }
  for (const double v : t.sheet.v[2]) {
    EXPECT_EQ(v, -100);
  }
  t.sheet.set_velocity({300, 0, 0}); // under the part that is there
  for (int k = 0; k < 150; ++k) {
    t.step();
  }
  for (std::size_t n = 0; n < t.sheet.mass.size(); ++n) {
    EXPECT_EQ(t.sheet.v[0][n], 300);
    EXPECT_EQ(t.sheet.v[2][n], 0);
  }
  EXPECT_EQ(t.active, 0);
  OnFloor<3> beside = t; // beside the hole the sheet holds
  beside.state = {};
  beside.sheet = flat_sheet<3>(2, 0.0005, 0.002, 2e-4, -1, 1e-3);
  beside.sheet.set_velocity({0, 0, -100});
  for (int k = 0; k < 100; ++k) {
    beside.step();
  }
  for (const double z : beside.sheet.x[2]) {
    EXPECT_NEAR(z, 0, 1e-3 * 100 * dt * 100); // 100 steps' drift at what the sweeps leave
  }
}

// A segment turned over in a fold, as in a crumpled sheet: the normals of its corners nearly cancel, depths along their mean
// mean nothing. Points all around the fold, above the sheet, are not inside it.
TEST(ContactPath, FoldedSegmentsHaveNoFoot) {
  Sheet<2> sheet;
  sheet.segments = {5, 1};
  sheet.x = {std::vector<double>{0, 2, 4, 3.999, 2.5, 6}, std::vector<double>{0, 0, 0.1, 0.1, 0.05, 0}};
  sheet.v = {std::vector<double>(6, 0.0), std::vector<double>(6, 0.0)};
  sheet.mass.assign(6, 1.0);
  const ContactSurface<2> s = sheet.view();
  for (int k = 0; k <= 40; ++k) {
    const Foot<2> foot = find_foot<2>(s, 2, {3 + 0.05 * k, 0.15}, {0.5, 0});
    EXPECT_FALSE(foot.found && foot.local[0] >= 0 && foot.local[0] <= 1 && foot.gap < 0) << 3 + 0.05 * k << ": " << foot.gap;
  }
}

TEST(ContactPath, UnusableSurfacesAreRefused) {
  OnFloor<2> t;
  t.floor = flat_sheet<2>(4, 0, 0.01, 0, 1, 1);
  t.sheet = flat_sheet<2>(4, 0, 0.01, 0, -1, 1);
  t.sheet.mass[2] = 0;
  EXPECT_ANY_THROW(t.step());
}

} // namespace
} // namespace ballast
