// The element: forces are minus the slope of its energy, rigid motions have none, and nothing else is without.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized" // g++ 12 in its own AVX-512 header, by way of Eigen
#include "ale/layers/layer_element.hpp"
#include "tests/layers/stacks.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

struct Case {
  std::string name;
  FabricModel model;
  bool ring = false;
  double inner = 0; ///< radius
};

template <int Dim> LayerStack<Dim> one_element(const Case& c, double kappa) {
  LayerInput in = brick(c.model, {1, 1, 1}, {0.9e-3, 1.1e-3, 0.7e-3}, Dim);
  in.axisymmetric = c.ring;
  for (double& r : in.lines[0]) {
    r += c.inner;
  }
  if (c.ring && c.inner == 0) {
    in.edge[0][0] = LayerEdge::symmetry;
  }
  in.hourglass = {kappa, 0};
  return make_stack<Dim>(in);
}

/// Energy at the positions, by the law's own strain energy at the points: what the forces derive from.
template <int Dim> long double discrete_energy(const LayerStack<Dim>& s, const FabricTensor& C) {
  using namespace layer_element;
  std::array<std::array<const double*, Dim>, Count<Dim>::rows> rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t d = 0; d < Dim; ++d) {
      rows[r][d] = s.position[d].data() + 2 * r;
    }
  }
  const Gradients a{s.at_rest.gradient[0], Dim == 3 ? 2 / (s.lines[1].back() - s.lines[1].front()) : s.at_rest.hoop[0], 2 / (s.levels[1] - s.levels[0])};
  const double V = s.at_rest.span[0] * (s.levels[1] - s.levels[0]) * (Dim == 3 ? 2 / a.a2 : 1.0);
  const Modes<Dim> c = modes_at(rows, 0);
  const Strains<Dim> E = strains(c, a);
  const bool isotropic = std::holds_alternative<HookeSolid>(s.model);
  const double nu = isotropic ? std::get<HookeSolid>(s.model).poisson : 0.0;
  const double vary = -0.5 * nu / (1 - nu) * (E[1] - E[0] + E[3] - E[2]);
  long double w = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    const double side = p == 0 ? -vary : vary;
    FabricTensor t = {E[p], E[2 + p], 0, 0, 0, 0};
    if constexpr (Dim == 3) {
      t = {E[p], E[2 + p], E[s33] + side, 0.5 * E[s12_low + p], 0.5 * E[s23], 0.5 * E[s13]};
    } else {
      t = {E[p], E[2 + p], E[e33] + side, 0, 0, 0.5 * E[e13]};
    }
    w += 0.5 * std::visit([&](const auto& law) { return strain_energy(law, t); }, s.model);
  }
  const Hourglass<Dim> H = hourglass_form(c, c, a);
  const double through = std::max(C[2], std::min(C[0], C[1]));
  std::array<double, Count<Dim>::hourglass> K = {through / 3};
  if constexpr (Dim == 3) {
    K = {C[0] / 3, C[1] / 3, C[5] / 3, C[4] / 3, through / 3, through / 3, C[0] / 9, C[1] / 9, through / 9};
  }
  for (std::size_t k = 0; k < K.size(); ++k) {
    w += 0.5 * s.hourglass.stiffness * K[k] * 0.25 * H[k] * H[k];
  }
  return static_cast<long double>(V) * w;
}

template <int Dim> void forces_are_slopes(const Case& c) {
  ThreadPool pool(1);
  LayerLedger ledger;
  FabricState fresh;
  const FabricTensor C = std::visit([&](const auto& law) { return evaluate(law, FabricTensor{}, fresh).tangent; }, c.model);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    LayerStack<Dim> s = one_element<Dim>(c, 0.3);
    place(s, s.position, [](std::array<double, Dim> X) {
      X[0] *= 1.08;
      X[Dim - 1] = 0.8 * X[Dim - 1] + 0.1 * X[0];
      return X;
    });
    shake(s, 5e-5, seed);
    update_forces(s, 0.0, ledger, pool);
    const double most = largest_force(s), step = 2e-8;
    for (std::size_t n = 0; n < s.node_count(); ++n) {
      for (std::size_t d = 0; d < Dim; ++d) {
        LayerStack<Dim> t = s;
        const auto energy = [&](double by) {
          t.position[d][n] = s.position[d][n] + by;
          return discrete_energy(t, C);
        };
        // Fourth order; what is left is rounding of the energy over the step.
        const long double slope = (8 * (energy(step) - energy(-step)) - (energy(2 * step) - energy(-2 * step))) / (12 * step);
        EXPECT_NEAR(s.force[d][n], -static_cast<double>(slope), 1e-8 * most) << c.name << " node " << n << " component " << d;
      }
    }
  }
}

TEST(LayerElement, ForcesAreMinusTheSlopeOfEnergy) {
  for (const auto& [name, model] : {std::pair<std::string, FabricModel>{"hooke", hooke()}, {"printed", fabric_laws::paper()}}) {
    forces_are_slopes<2>({name + " plane", model});
    forces_are_slopes<2>({name + " ring", model, true, 2e-3});
    forces_are_slopes<2>({name + " at the axis", model, true, 0});
    forces_are_slopes<3>({name + " 3D", model});
  }
}

TEST(LayerElement, RotationGivesNoForceAndNoStrain) {
  ThreadPool pool(1);
  LayerLedger ledger;
  LayerStack<3> s = one_element<3>({"", hooke()}, 0.3);
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(1.9, Eigen::Vector3d(0.3, -0.8, 0.5).normalized())).toRotationMatrix();
  place(s, s.position, [&R](std::array<double, 3> X) -> std::array<double, 3> {
    const Eigen::Vector3d x = R * Eigen::Vector3d(X[0], X[1], X[2]) + Eigen::Vector3d(1e-2, 2e-2, 0);
    return {x[0], x[1], x[2]};
  });
  update_forces(s, 0.0, ledger, pool);
  EXPECT_LT(largest_force(s), 1e-12 * 74e9 * 1e-6); // of C h^2; rounding of places of 2e-2 by h is 1e-15 times 1/h^2 of ...
  LayerStack<2> p = one_element<2>({"", hooke()}, 0.3);
  place(p, p.position, [](std::array<double, 2> X) -> std::array<double, 2> {
    return {std::cos(2.2) * X[0] - std::sin(2.2) * X[1], std::sin(2.2) * X[0] + std::cos(2.2) * X[1]};
  });
  update_forces(p, 0.0, ledger, pool);
  EXPECT_LT(largest_force(p), 1e-12 * 74e9 * 1e-3);
}

/// Stiffness of one element at rest by differences, scaled by C h.
template <int Dim> Eigen::MatrixXd stiffness_at_rest(const Case& c, double kappa) {
  ThreadPool pool(1);
  LayerLedger ledger;
  LayerStack<Dim> s = one_element<Dim>(c, kappa);
  const auto nodes = static_cast<Eigen::Index>(s.node_count());
  Eigen::MatrixXd K(nodes * Dim, nodes * Dim);
  const double step = 1e-9;
  for (Eigen::Index col = 0; col < K.cols(); ++col) {
    const auto n = static_cast<std::size_t>(col / Dim), d = static_cast<std::size_t>(col % Dim);
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(K.rows());
    for (const double sign : {1.0, -1.0}) {
      s.position = s.rest;
      s.position[d][n] += sign * step;
      update_forces(s, 0.0, ledger, pool);
      for (Eigen::Index row = 0; row < K.rows(); ++row) {
        difference[row] -= sign * s.force[static_cast<std::size_t>(row % Dim)][static_cast<std::size_t>(row / Dim)];
      }
    }
    K.col(col) = difference / (2 * step);
  }
  return 0.5 * (K + K.transpose());
}

template <int Dim> int modes_without_energy(const Case& c, double kappa) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness_at_rest<Dim>(c, kappa)).eigenvalues();
  int without = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    without += values[k] < 1e-6 * values[values.size() - 1] ? 1 : 0;
    EXPECT_GT(values[k], -1e-6 * values[values.size() - 1]) << c.name;
  }
  return without;
}

TEST(LayerElement, OnlyRigidMotionsAreWithoutEnergy) {
  const Case plane{"plane", hooke()}, ring{"ring", hooke(), true, 2e-3}, axis{"axis", hooke(), true, 0};
  EXPECT_EQ(modes_without_energy<2>(plane, 0.05), 3);
  EXPECT_EQ(modes_without_energy<2>(ring, 0.05), 1);
  EXPECT_EQ(modes_without_energy<3>(plane, 0.05), 6);
  // Without stabilisation: those, and the element's modes without strain at its points.
  EXPECT_EQ(modes_without_energy<2>(plane, 0), 4);
  EXPECT_EQ(modes_without_energy<2>(ring, 0), 2);
  EXPECT_EQ(modes_without_energy<3>(plane, 0), 15);
}

/// A row of elements bent to an arc with its cross-sections straight and normal.
template <int Dim> LayerStack<Dim> arc(const FabricModel& model, int n, double length, double thickness, double angle) {
  LayerStack<Dim> s = make_stack<Dim>(brick(model, {n, 2, 1}, {length / n, 1e-3, thickness}, Dim));
  place(s, s.position, [&](std::array<double, Dim> X) {
    const double z = X[Dim - 1] - thickness / 2, turned = angle * X[0] / length, R = length / angle;
    X[0] = (R - z) * std::sin(turned);
    X[Dim - 1] = R - (R - z) * std::cos(turned);
    return X;
  });
  return s;
}

TEST(LayerElement, BendsWithoutShearOrHourglassForces) {
  RaftenbergFabric law = fabric_laws::paper(); // stiff in shear, 50 GPa; soft in the plane
  ThreadPool pool(1);
  LayerLedger ledger;
  LayerStack<3> s = arc<3>(law, 20, 20e-3, 0.1e-3, 1.0);
  update_forces(s, 0.0, ledger, pool);
  const double V = 1e-3 * 1e-3 * 0.1e-3;
  for (int i = 0; i < 20; ++i) {
    for (const std::size_t shear : {std::size_t{layer_element::s13}, std::size_t{layer_element::s23}}) {
      EXPECT_LT(std::abs(s.stress_volume[s.in_row(shear, 9, 0, 0) + static_cast<std::size_t>(i)]), 1e-12 * 50e9 * V);
    }
  }
  for (const double held : s.hourglass_volume) {
    EXPECT_LT(std::abs(held), 1e-12 * 50e9 * V);
  }
}

TEST(LayerElement, MassIsThatOfItsVolume) {
  LayerInput in = brick(hooke(), {7, 5, 3}, {1e-3, 2e-3, 0.5e-3}, 3, 2);
  in.lines[0] = {0, 1e-3, 2.5e-3, 4e-3, 8e-3};
  const LayerStack<3> s = make_stack<3>(in);
  EXPECT_NEAR(totals(s).mass / (1440 * 8e-3 * 10e-3 * 3e-3), 1, 1e-14);
  LayerInput ring = brick(hooke(), {7, 1, 3}, {1e-3, 2e-3, 0.5e-3}, 2, 2);
  ring.axisymmetric = true;
  ring.edge[0][0] = LayerEdge::symmetry;
  ring.lines[0] = {0, 1e-3, 2.5e-3, 4e-3, 8e-3};
  const LayerStack<2> r = make_stack<2>(ring);
  EXPECT_NEAR(totals(r).mass / (1440 * 3.141592653589793 * 64e-6 * 3e-3), 1, 1e-14);
  // The node on the axis has a disc of half the first width, half a level thick.
  EXPECT_NEAR(r.mass[r.node(0, 0, 0)] / (1440 * 3.141592653589793 * 0.25e-6 * 0.25e-3), 1, 1e-14);
}

} // namespace
} // namespace ballast
