// Slidelines of a stack: layers squeezed, sheared and thrown about between end plates; rest; threads; holes; edges.
// The layers' stiffness is the test's own: springs through and along that stiffen as ln(h/h0) h0/h, and shear, stiff enough that no quad turns over (a fold would need self-contact).
#include "ale/layers/slideline.hpp"

#include "sheets.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double thickness = 3.63e-3, density = 800, modulus = 1e9, width = 0.01; // of all layers: m, kg/m3, Pa, m

template <int Dim> LayerStack<Dim> make_springs(int n, int layers) {
  LayerStack<Dim> s;
  s.grid.elements = {n, Dim == 3 ? n : 1};
  s.grid.layers = layers;
  s.density = density;
  const double h = thickness / layers, spacing = width / n;
  for (int l = 0; l <= layers; ++l) {
    s.levels.push_back(h * l);
  }
  const int rows = Dim == 3 ? n + 1 : 1;
  for (int p = 0; p < s.grid.planes(); ++p) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i <= n; ++i) {
        const std::array<double, 3> x = {spacing * i, spacing * j, h * ((p + 1) / 2)};
        for (std::size_t d = 0; d < Dim; ++d) {
          s.rest[d].push_back(d == Dim - 1 ? x[2] : x[d]);
          s.velocity[d].push_back(0);
          s.force[d].push_back(0);
        }
        const double share = (i == 0 || i == n ? 0.5 : 1) * (Dim == 3 && (j == 0 || j == n) ? 0.5 : 1);
        s.mass.push_back(0.5 * share * density * h * spacing * (Dim == 3 ? spacing : 1));
      }
    }
  }
  s.position = s.rest;
  s.energy.assign(static_cast<std::size_t>(n * (Dim == 3 ? n : 1) * layers), 0);
  s.alive.assign(s.energy.size(), 1);
  return s;
}

/// Forces of the springs, into s.force.
template <int Dim> void pull_springs(LayerStack<Dim>& s) {
  const int n = s.grid.elements[0], rows = Dim == 3 ? n + 1 : 1;
  const double h = thickness / s.grid.layers, spacing = width / n;
  for (auto& f : s.force) {
    std::fill(f.begin(), f.end(), 0.0);
  }
  // Along `axis` as ln(stretch)/stretch, so that nothing turns over; across it linear.
  const auto tie = [&](std::size_t a, std::size_t b, std::size_t axis, double apart, double area, double shear) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double stretch = (s.position[d][b] - s.position[d][a]) / apart;
      double f = shear * modulus * area * (stretch - (s.rest[d][b] - s.rest[d][a]) / apart);
      if (d == axis) {
        EXPECT_GT(stretch, 0);
        f = modulus * area * (stretch < 1 ? std::log(stretch) / stretch : stretch - 1);
      }
      s.force[d][a] += f;
      s.force[d][b] -= f;
    }
  };
  const double depth = Dim == 3 ? spacing : 1;
  for (int p = 0; p < s.grid.planes(); ++p) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i <= n; ++i) {
        const std::size_t a = s.node(i, j, p);
        if (i < n) {
          tie(a, s.node(i + 1, j, p), 0, spacing, 0.5 * h * depth, 0.3);
        }
        if (Dim == 3 && j < n) {
          tie(a, s.node(i, j + 1, p), 1, spacing, 0.5 * h * depth, 0.3);
        }
        if (p % 2 == 0) {
          tie(a, s.node(i, j, p + 1), Dim - 1, h, s.mass[a] / (0.5 * density * h), 0.2);
        }
      }
    }
  }
}

struct Squeeze {
  double deepest = 0, loss = 0, least = 1; ///< by a layer's thickness, J, thickness left
  long active = 0, behind = 0;
};

/// The top plate comes down by `share` of the thickness, unevenly; layers start with a slide and a scatter of their own.
template <int Dim> Squeeze squeeze(LayerStack<Dim>& s, double share, double speed, ThreadPool& pool, const ContactSettings& settings = {}) {
  const int layers = s.grid.layers, planes = s.grid.planes();
  const double h = thickness / layers, dt = 0.25 * h * (1.03 - share) / std::sqrt(3.5 * modulus / density);
  for (std::size_t n = 0; n < s.mass.size(); ++n) {
    const auto layer = n * static_cast<std::size_t>(layers) / s.mass.size();
    for (std::size_t d = 0; d < Dim; ++d) {
      s.velocity[d][n] = 0.05 * speed * scatter(n * Dim + d) + (d == 0 ? (layer % 2 == 0 ? 1 : -1) * 0.2 * speed : 0);
    }
  }
  SlidelineState<Dim> state;
  Squeeze out;
  const std::size_t plane = s.mass.size() / static_cast<std::size_t>(planes), top = s.mass.size() - plane;
  for (double t = 0; t * speed < share * thickness; t += dt) {
    pull_springs(s);
    for (std::size_t d = 0; d < Dim; ++d) {
      for (std::size_t n = 0; n < s.mass.size(); ++n) {
        s.velocity[d][n] += dt * s.force[d][n] / s.mass[n];
      }
    }
    for (std::size_t n = 0; n < plane; ++n) {
      s.velocity[Dim - 1][n] = 0;
      s.velocity[Dim - 1][top + n] = -speed * (1 - 0.3 * std::sin(600 * s.rest[0][n]) * std::sin(600 * s.rest[0][n]));
    }
    const SlidelineReport r = resolve_slidelines(s, dt, s.velocity, pool, settings, state);
    for (std::size_t d = 0; d < Dim; ++d) {
      for (std::size_t n = 0; n < s.mass.size(); ++n) {
        s.position[d][n] += dt * s.velocity[d][n];
      }
    }
    out.deepest = std::max(out.deepest, r.contact.deepest / h);
    out.loss += r.contact.loss;
    out.active += r.contact.active;
    out.behind = std::max(out.behind, r.contact.behind);
  }
  for (std::size_t n = 0; n < plane; ++n) {
    out.least = std::min(out.least, (s.position[Dim - 1][top + n] - s.position[Dim - 1][n]) / thickness);
  }
  return out;
}

template <int Dim> void expect_squeezes(int n, int layers, double allowed) {
  ThreadPool pool(2);
  LayerStack<Dim> s = make_springs<Dim>(n, layers);
  const Squeeze q = squeeze(s, 0.9, 200, pool);
  EXPECT_LT(q.deepest, allowed) << Dim << "D, " << layers << " layers";
  EXPECT_LT(q.least, 0.11);
  EXPECT_GE(q.loss, 0);
  EXPECT_LT(q.behind, 20); // at rims that slid past each other
  for (const double z : s.position[Dim - 1]) {
    EXPECT_TRUE(std::isfinite(z));
  }
}

// Squeezed to a tenth: it ends, with at most 1 % of a layer inside its neighbour (5 % for 29 layers).
TEST(Slidelines, SqueezedStacksKeepTheirLayersApart) {
  for (const int layers : {2, 5, 10}) {
    expect_squeezes<2>(12, layers, 0.01);
  }
  expect_squeezes<2>(8, 29, 0.05);
  expect_squeezes<3>(5, 2, 0.01);
  expect_squeezes<3>(5, 5, 0.01);
}

TEST(Slidelines, SameBitsForAnyThreads) {
  std::array<std::vector<double>, 3> first;
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    LayerStack<3> s = make_springs<3>(8, 5);
    ContactSettings settings;
    settings.friction = 0.2;
    const Squeeze q = squeeze(s, 0.3, 200, pool, settings);
    EXPECT_GT(q.active, 1000);
    if (threads == 1) {
      first = s.position;
    } else {
      EXPECT_EQ(s.position, first);
    }
  }
}

TEST(Slidelines, TouchingLayersRest) {
  ThreadPool pool(2);
  LayerStack<3> s = make_springs<3>(8, 10);
  SlidelineState<3> state;
  for (int k = 0; k < 3; ++k) {
    const SlidelineReport r = resolve_slidelines(s, 1e-7, s.velocity, pool, {}, state);
    EXPECT_EQ(r.contact.active, 0);
    EXPECT_EQ(r.contact.deepest, 0);
    EXPECT_EQ(r.contact.loss, 0);
    EXPECT_EQ(r.deepest_pair, -1);
  }
  for (const auto& v : s.velocity) {
    EXPECT_EQ(v, std::vector<double>(s.mass.size(), 0.0));
  }
}

// Momentum of a stack in flight whose layers run into each other, 1e-13; the approach is reported by the layer's thickness.
TEST(Slidelines, KeepMomentum) {
  ThreadPool pool(2);
  LayerStack<3> s = make_springs<3>(7, 5);
  double size = 0;
  std::array<double, 3> before{}, after{};
  for (std::size_t n = 0; n < s.mass.size(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      s.velocity[d][n] = 100 * scatter(3 * n + d);
      before[d] += s.mass[n] * s.velocity[d][n];
    }
    size += 100 * s.mass[n];
  }
  SlidelineState<3> state;
  const SlidelineReport r = resolve_slidelines(s, 1e-6, s.velocity, pool, {}, state);
  for (std::size_t n = 0; n < s.mass.size(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) {
      after[d] += s.mass[n] * s.velocity[d][n];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(after[d], before[d], 1e-13 * size);
  }
  EXPECT_GT(r.contact.loss, 0);
  EXPECT_GT(r.closing_share, 1e-4 / (thickness / 5));
  EXPECT_LT(r.closing_share, 2e-4 / (thickness / 5));
}

// Edges: symmetry holds what is across it, fixed all, free and elastic ones nothing.
TEST(Slidelines, EdgesHoldWhatTheyHold) {
  LayerStack<3> s = make_springs<3>(3, 2);
  s.edge = {{{LayerEdge::symmetry, LayerEdge::fixed}, {LayerEdge::symmetry, LayerEdge::free}}};
  EXPECT_EQ(held_nodes(s), (std::vector<unsigned char>{3, 2, 2, 7, 1, 0, 0, 7, 1, 0, 0, 7, 1, 0, 0, 7}));
}

// An eroded element of the upper layer opens the slideline there and nowhere else.
TEST(Slidelines, ErodedElementsAreHoles) {
  ThreadPool pool(1);
  LayerStack<2> s = make_springs<2>(10, 2);
  for (int i = 3; i < 7; ++i) {
    s.alive[s.element(i, 0, 1)] = 0;
  }
  for (int i = 0; i <= 10; ++i) {
    s.velocity[1][s.node(i, 0, 1)] = 50; // the lower layer's upper plane
  }
  SlidelineState<2> state;
  resolve_slidelines(s, 1e-7, s.velocity, pool, {}, state);
  for (int i = 0; i <= 10; ++i) {
    const double v = s.velocity[1][s.node(i, 0, 1)];
    EXPECT_NEAR(v, i > 3 && i < 7 ? 50 : 25, 1e-2);
  }
}

/// Layers 0 and 3 of a stack whose two layers between have a hole in the middle: what of the lowest is thrown at it meets the top one there, and the
/// momentum of all is kept.
template <int Dim> void expect_layers_meet_through_holes() {
  ThreadPool pool(2);
  constexpr int n = 10;
  LayerStack<Dim> s = make_springs<Dim>(n, 4);
  const auto in_hole = [](int i, int least) { return i >= 3 + least && i <= 7 - least; };
  for (int layer : {1, 2}) {
    for (int j = 0; j < (Dim == 3 ? n : 1); ++j) {
      for (int i = 3; i < 7; ++i) {
        s.alive[s.element(i, j, layer)] = Dim == 2 || (j >= 3 && j < 7) ? 0 : 1;
      }
    }
  }
  const double h = thickness / 4, dt = 1e-7, speed = 100;
  const int rows = Dim == 3 ? n + 1 : 1;
  double before = 0, after = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool over = in_hole(i, 1) && (Dim == 2 || in_hole(j, 1)); // no segment of the layers between is there
      s.velocity[Dim - 1][s.node(i, j, 1)] = over ? speed : 0;
      before += over ? speed * s.mass[s.node(i, j, 1)] : 0;
    }
  }
  SlidelineState<Dim> state;
  for (int step = 0; step < static_cast<int>(2.5 * h / speed / dt); ++step) {
    resolve_slidelines(s, dt, s.velocity, pool, {}, state);
    for (std::size_t q = 0; q < s.mass.size(); ++q) {
      for (std::size_t d = 0; d < Dim; ++d) {
        s.position[d][q] += dt * s.velocity[d][q];
      }
    }
  }
  for (std::size_t q = 0; q < s.mass.size(); ++q) {
    after += s.mass[q] * s.velocity[Dim - 1][q];
  }
  EXPECT_NEAR(after, before, 1e-13 * before);
  const std::size_t low = s.node(5, Dim == 3 ? 5 : 0, 1), high = s.node(5, Dim == 3 ? 5 : 0, 6);
  EXPECT_NEAR(s.velocity[Dim - 1][low], 0.5 * speed, 0.02 * speed);
  EXPECT_NEAR(s.velocity[Dim - 1][high], 0.5 * speed, 0.02 * speed);
  EXPECT_LT(s.position[Dim - 1][low] - s.position[Dim - 1][high], 1e-3 * h);
  EXPECT_EQ(state.holes.size(), 3U); // 0 and 2, 0 and 3, 1 and 3
}

TEST(Slidelines, LayersMeetThroughHolesOfThoseBetween) { expect_layers_meet_through_holes<2>(); }
TEST(Slidelines, LayersMeetThroughHolesOfThoseBetweenInSpace) { expect_layers_meet_through_holes<3>(); }

} // namespace
} // namespace ballast
