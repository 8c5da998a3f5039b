// Two elastic bars meet: chains of masses and springs, side by side and tied by shear, in node-to-segment contact at their ends.
// Exact: pressure Z1 Z2/(Z1 + Z2) V, Z = rho c; equal bars exchange their velocities; momentum.
#include "sheets.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

struct BarMaterial {
  double density, modulus; // kg/m3, Pa
  double impedance() const { return std::sqrt(density * modulus); }
  double wave_speed() const { return std::sqrt(modulus / density); }
};

constexpr double width = 0.01, length = 0.05; // m; 1 m deep

/// A bar along axis 1 of a plane, columns by rows elements; end: +1 its upper end touches, -1 its lower.
struct Bar {
  Sheet<2> nodes; // all of them, row by row: only its arrays are used
  int columns, rows, end;
  BarMaterial material;
  double from;
  std::vector<double> force, none;
  std::array<std::vector<double>, 2> half; ///< of the velocity at the step's start

  Bar(int c, int r, int e, BarMaterial m, double y, double speed) : columns(c), rows(r), end(e), material(m), from(y) {
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) {
        nodes.x[0].push_back(width * i / columns);
        nodes.x[1].push_back(y + length * j / rows);
        nodes.v[0].push_back(0);
        nodes.v[1].push_back(speed);
        nodes.mass.push_back(column_area(i) * material.density * length / rows * (j == 0 || j == rows ? 0.5 : 1));
      }
    }
    force.resize(nodes.mass.size());
    none.resize(nodes.mass.size());
  }
  double column_area(int i) const { return width / columns * (i == 0 || i == columns ? 0.5 : 1); }
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(j * (columns + 1) + i); }
  double lift(const std::vector<double>& y, int i, int j) const { return y[at(i, j)] - (from + length * j / rows); }

  /// Calls visit(a, b, stiffness, elongation from a to b) for every spring: along the bar, and shear between columns.
  template <class Visit> void for_each_spring(const std::vector<double>& y, Visit&& visit) const {
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) {
        if (j < rows) {
          visit(at(i, j), at(i, j + 1), column_area(i) * material.modulus * rows / length, lift(y, i, j + 1) - lift(y, i, j));
        }
        if (i < columns) {
          visit(at(i, j), at(i + 1, j), 0.3 * material.modulus * length / rows * columns / width, lift(y, i + 1, j) - lift(y, i, j));
        }
      }
    }
  }
  void accelerate(double dt) {
    std::fill(force.begin(), force.end(), 0.0);
    for_each_spring(nodes.x[1], [&](std::size_t a, std::size_t b, double stiffness, double elongation) {
      force[a] += stiffness * elongation;
      force[b] -= stiffness * elongation;
    });
    for (std::size_t n = 0; n < force.size(); ++n) {
      nodes.v[1][n] += dt * force[n] / nodes.mass[n];
    }
  }
  /// What leapfrog keeps: kinetic energy at the half step and the springs' by elongations before and after it.
  double energy(const std::vector<double>& y_n) const {
    std::vector<double> after;
    for_each_spring(nodes.x[1], [&](std::size_t, std::size_t, double, double elongation) { after.push_back(elongation); });
    double e = nodes.kinetic_energy();
    std::size_t k = 0;
    for_each_spring(y_n, [&](std::size_t, std::size_t, double stiffness, double elongation) { e += 0.5 * stiffness * elongation * after[k++]; });
    return e;
  }
  ContactSurface<2> face() {
    const std::size_t first = end > 0 ? at(0, rows) : 0;
    ContactSurface<2> s;
    s.segments = {columns, 1};
    s.position = {nodes.x[0].data() + first, nodes.x[1].data() + first};
    s.velocity = {nodes.v[0].data() + first, nodes.v[1].data() + first};
    s.mass = nodes.mass.data() + first;
    s.force = {none.data() + first, force.data() + first};
    s.outside = end;
    return s;
  }
  double mean_speed() const { return nodes.momentum()[1] / (material.density * width * length); }
};

/// How nodes move by their velocities: as layers do, or by the mean of a step's two velocities, as blocks do.
enum class Mover { leapfrog, mean };

struct Impact {
  double speed_a, speed_b, plateau, deepest, loss, unaccounted; ///< m/s, Pa, m, J, of the energy at the start
};

/// A step's end for one bar: forces, and the arrays of a face that moves by mean velocities.
void kick(Bar& bar, Mover mover, const std::array<std::vector<double>, 2>& v, double dt, ContactSurface<2>& face) {
  const auto x = bar.nodes.x;
  if (mover == Mover::mean) { // forces at the half step
    bar.nodes.move(0.5 * dt);
  }
  bar.accelerate(dt);
  bar.nodes.x = x;
  face = bar.face();
  if (mover == Mover::mean) {
    bar.half = v;
    for (std::size_t d = 0; d < 2; ++d) {
      for (double& u : bar.half[d]) {
        u *= 0.5;
      }
      const auto first = face.velocity[d] - bar.nodes.v[d].data();
      face.velocity_n[d] = v[d].data() + first;
      face.fixed[d] = bar.half[d].data() + first;
    }
    face.weight = 0.5;
  }
}

void drift(Bar& bar, Mover mover, const std::array<std::vector<double>, 2>& v, double dt) {
  for (std::size_t n = 0; n < bar.nodes.mass.size(); ++n) {
    const double now = bar.nodes.v[1][n];
    bar.nodes.x[1][n] += dt * (mover == Mover::mean ? 0.5 * (now + v[1][n]) : now);
  }
}

Impact strike(Bar a, Bar b, Mover mover_a, Mover mover_b) {
  const double fastest = std::max(a.material.wave_speed(), b.material.wave_speed()), dt = 0.3 * length / a.rows / fastest, crossing = length / fastest;
  const auto momentum = [&] { return a.nodes.momentum()[1] + b.nodes.momentum()[1]; };
  const double p0 = momentum(), e0 = a.nodes.kinetic_energy() + b.nodes.kinetic_energy();
  ContactState<2> state;
  Impact out{};
  double impulse = 0;
  long plateau_steps = 0;
  for (int k = 0; k * dt < 4 * crossing; ++k) {
    const auto va = a.nodes.v, vb = b.nodes.v;
    const auto xa = a.nodes.x, xb = b.nodes.x;
    ContactSurface<2> fa, fb;
    kick(a, mover_a, va, dt, fa);
    kick(b, mover_b, vb, dt, fb);
    const ContactReport r = resolve_contact(fa, fb, dt, {}, state);
    out.deepest = std::max(out.deepest, r.deepest);
    out.loss += r.loss;
    if (k * dt > 0.3 * crossing && k * dt < 1.7 * crossing) {
      impulse += r.impulse;
      ++plateau_steps;
    }
    drift(a, mover_a, va, dt);
    drift(b, mover_b, vb, dt);
    EXPECT_NEAR(momentum(), p0, 1e-12 * std::abs(p0));
    if (mover_a == Mover::leapfrog && mover_b == Mover::leapfrog) {
      out.unaccounted = std::max(out.unaccounted, std::abs(a.energy(xa[1]) + b.energy(xb[1]) + out.loss - e0) / e0);
    }
  }
  out.speed_a = a.mean_speed();
  out.speed_b = b.mean_speed();
  out.plateau = impulse / (static_cast<double>(plateau_steps) * dt * width);
  return out;
}

constexpr BarMaterial steel{7800, 200e9}, aluminium{2700, 70e9};
constexpr double speed = 10;

constexpr std::array<std::array<Mover, 2>, 3> movers = {{{Mover::leapfrog, Mover::leapfrog}, {Mover::mean, Mover::mean}, {Mover::mean, Mover::leapfrog}}};

// Speeds within 1 %, pressure within 2 %; what is lost when masses at the faces meet is about one of 200 cells' energy.
TEST(ContactImpact, EqualBarsExchangeVelocities) {
  for (const auto& [ma, mb] : movers) {
    for (const auto& [columns_a, columns_b] : {std::pair(4, 4), std::pair(4, 9), std::pair(5, 2)}) {
      const Impact i = strike(Bar(columns_a, 200, 1, steel, -length, speed), Bar(columns_b, 200, -1, steel, 1e-9, 0), ma, mb);
      const double pressure = 0.5 * steel.impedance() * speed, energy = 0.5 * steel.density * width * length * speed * speed;
      EXPECT_NEAR(i.speed_a, 0, 0.01 * speed);
      EXPECT_NEAR(i.speed_b, speed, 0.01 * speed);
      EXPECT_NEAR(i.plateau, pressure, 0.02 * pressure);
      EXPECT_LT(i.deepest, 1e-5 * length / 200);
      EXPECT_GE(i.loss, 0);
      EXPECT_LT(i.loss, 0.005 * energy);
      EXPECT_LT(i.unaccounted, 1e-12);
    }
  }
}

TEST(ContactImpact, PressureIsThatOfImpedances) {
  const double z1 = steel.impedance(), z2 = aluminium.impedance(), pressure = z1 * z2 / (z1 + z2) * speed;
  for (const auto& [ma, mb] : movers) {
    const Impact i = strike(Bar(4, 200, 1, steel, -length, speed), Bar(7, 200, -1, aluminium, 1e-9, 0), ma, mb);
    EXPECT_NEAR(i.plateau, pressure, 0.02 * pressure);
  }
}

} // namespace
} // namespace ballast
