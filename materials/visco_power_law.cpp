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

// y' = pull - n y, n = (dt/tau0) (|y|/s0)^(m-1); dissipation n y:y/(2G).
void rate(const PowerLawBranch& m, const PowerLawDrive& drive, double, const double* y, double* rate) {
  const Sym s{y[0], y[1], y[2], y[3], y[4], y[5]};
  const double square = contract(s, s), n = relaxation_number(m, drive.dt, square);
  for (std::size_t a = 0; a < 6; ++a) {
    rate[a] = drive.pull[a] - n * s[a];
  }
  rate[6] = n * square / (2 * m.shear);
}

void jacobian(const PowerLawBranch& m, const PowerLawDrive& drive, double, const double* y, BranchJacobian& out) {
  const Sym s{y[0], y[1], y[2], y[3], y[4], y[5]};
  const double square = contract(s, s), n = relaxation_number(m, drive.dt, square);
  const double steep = square > 0 ? n * (m.exponent - 1) / square : 0;
  for (std::size_t b = 0; b < 6; ++b) {
    const double along = (b < 3 ? 1 : 2) * s[b]; // half the derivative of s:s
    for (std::size_t a = 0; a < 6; ++a) {
      out[6 * a + b] = -steep * s[a] * along - (a == b ? n : 0);
    }
    out[36 + b] = n * (m.exponent + 1) * along / (2 * m.shear);
  }
}

double error_scale(const PowerLawBranch& m, const double* y) {
  return std::max(norm(Sym{y[0], y[1], y[2], y[3], y[4], y[5]}), 0.01 * m.reference);
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
