// Blocks of one viscoelastic material for tests of its coupling to the step.
#pragma once

#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/simulation.hpp"
#include "materials/visco.hpp"

#include <numeric>
#include <utility>

namespace ballast {

inline std::vector<double> even_lines(double from, double to, int cells) {
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i) {
    x.push_back(from + (to - from) * i / cells);
  }
  return x;
}

inline Material tissue_of(const TissueLaw& law, double bulk_modulus = 20e6, double density = 1050) {
  Material m;
  m.name = "tissue";
  m.eos = LinearBulk{.rho0 = density, .K = bulk_modulus, .p0 = 0};
  m.strength = Viscoelastic{law};
  m.density = density;
  return m;
}

/// A block all of `material` on the given lines; walls all round, policy Lagrangian.
template <int Dim> Scene<Dim> tissue_scene(const Material& material, const std::array<std::vector<double>, 3>& lines, bool axisymmetric = false) {
  Scene<Dim> scene;
  scene.blocks.resize(1);
  Block<Dim>& b = scene.blocks[0];
  b.axisymmetric = axisymmetric;
  b.motion.policy = MotionPolicy::lagrangian;
  b.materials.push_back(make_slot(material, 0));
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const CellPart part{0, 1, material.density, material.specific_energy};
    fill_cell<Dim>(b, i, j, k, std::span<const CellPart>(&part, 1));
  });
  for (auto& axis : b.boundary.side) {
    axis[0].kind = axis[1].kind = BoundaryKind::wall;
  }
  scene.ledger.mass_out.assign(1, 0.0);
  return scene;
}

/// One material point that takes the steps of a cell.
class TissuePoint {
public:
  explicit TissuePoint(TissueLaw law) : law_(std::move(law)), state_(state_count(law_)) { set_rest(law_, state_); }

  void step(const Mat& gradient, double dt, double volume_ratio) {
    ViscoRow row;
    row.cells = 1;
    row.dt = dt;
    for (std::size_t q = 0; q < 9; ++q) {
      row.gradient[q] = &gradient[q];
    }
    row.volume_ratio = &volume_ratio;
    for (std::size_t q = 0; q < state_.size(); ++q) {
      row.state[q] = &state_[q];
    }
    for (std::size_t q = 0; q < 6; ++q) {
      row.stress[q] = &stress[q];
    }
    double heat = 0, done = 0;
    row.stored = &stored;
    row.dissipated = &heat;
    row.work = &done;
    failed = failed || advance(law_, integrator_, row).has_value();
    dissipated += heat;
    work += done;
  }

  Sym stress{}; ///< Cauchy deviator, Pa
  double stored = 0, dissipated = 0, work = 0; ///< J/m3 of initial volume
  bool failed = false;

private:
  TissueLaw law_;
  std::vector<double> state_;
  TissueIntegrator integrator_{TissueOptions{}};
};

/// One of each, of a few hundred kPa, with branches from 1 us to 100 us.
inline std::vector<TissueLaw> few_laws() {
  Prony prony{.long_shear = 1e5, .branches = 2};
  prony.branch[0] = {2e5, 1e-6};
  prony.branch[1] = {1e5, 1e-4};
  PowerLawZener power{.long_shear = 1e4, .branches = 1};
  power.branch[0] = {3e5, 1e-5, 5e3, 3};
  FungQlv fung{.shear = 3e5, .stiffening = 2, .branches = 2};
  fung.branch[0] = {0.4, 1e-6};
  fung.branch[1] = {0.3, 1e-4};
  const BergstroemBoyce boyce{.a = {1e5}, .b = {3e5}, .rate = 1e3, .base = 2e4, .exponent = 3};
  return {prony, power, fung, boyce};
}

} // namespace ballast
