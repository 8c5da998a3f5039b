#include "materials/visco_power_law.hpp"

#include <algorithm>

namespace ballast {

std::size_t state_count(const PowerLawZener& m) { return 6 * (m.branches + 1); }

std::vector<std::string> state_names(const PowerLawZener& m) {
  std::vector<std::string> names;
  append_tensor_names(names, "power_law_long");
  for (std::size_t b = 0; b < m.branches; ++b) {
    append_tensor_names(names, "power_law_" + std::to_string(b + 1));
  }
  return names;
}

void set_rest(const PowerLawZener& m, std::span<double> state) { std::fill_n(state.begin(), state_count(m), 0.0); }

double instant_shear(const PowerLawZener& m) {
  double sum = m.long_shear;
  for (std::size_t b = 0; b < m.branches; ++b) {
    sum += m.branch[b].shear;
  }
  return sum;
}

// v' = pull - n v, n = (dt/tau0) (|v|/s0)^(m-1); dissipation n v:v/(2G).
void rate(const PowerLawBranch& m, const PowerLawDrive& drive, double, const Sym& v, Sym& rate, double& heat) {
  const double square = contract(v, v), n = relaxation_number(m, drive.dt, square);
  rate = combine(1, drive.pull, -n, v);
  heat = n * square / (2 * m.shear);
}

void jacobian(const PowerLawBranch& m, const PowerLawDrive& drive, double, const Sym& v, BranchJacobian& out) {
  const double square = contract(v, v), n = relaxation_number(m, drive.dt, square);
  const Sym along = by_variables(v); // half the gradient of v:v
  out = {};
  out.diagonal = -n;
  out.left[0] = v;
  out.right[0] = scaled(square > 0 ? -n * (m.exponent - 1) / square : 0, along);
  out.heat = scaled(n * (m.exponent + 1) / (2 * m.shear), along);
}

double error_scale(const PowerLawBranch& m, const Sym& y) { return std::max(norm(y), 0.01 * m.reference); }

double elastic_number(const PowerLawBranch& m, const PowerLawDrive& drive, const Sym& y) {
  const Sym end = combine(1, y, 1, drive.pull); // |s|^2 is largest at one of the ends
  return relaxation_number(m, drive.dt, std::max(contract(y, y), contract(end, end)));
}

double stored_energy(const PowerLawBranch& m, const Sym& y) { return contract(y, y) / (4 * m.shear); }

FastStep fast_step(const PowerLawBranch& m, const PowerLawDrive& drive, const Sym& y, int substeps) {
  FastStep step{{y, 0}, 0};
  const double dt = drive.dt / substeps;
  const Sym pull = scaled(1.0 / substeps, drive.pull);
  const double pp = contract(pull, pull);
  for (int k = 0; k < substeps; ++k) {
    const Sym& s = step.state.y;
    const double ss = contract(s, s), sp = contract(s, pull);
    const double x = solve_relaxation([&](double guess) {
      const Weights w = weights(0.5 * guess);
      const double arrives = 0.5 * (w.start + w.keep); // of the pull, at half the step
      return relaxation_number(m, dt, std::max(0.0, w.keep * w.keep * ss + arrives * (2 * w.keep * sp + arrives * pp)));
    });
    const Relaxed end = relax_branch(s, pull, m.shear, x, relaxation(x));
    step.state = {end.stress, step.state.dissipated + end.dissipated};
    step.work += end.work;
  }
  return step;
}

} // namespace ballast
