#include "materials/visco_bergstroem_boyce.hpp"

#include <algorithm>

namespace ballast {

namespace {

Sym sym_of(const double* y) { return {y[0], y[1], y[2], y[3], y[4], y[5]}; }

/// b at s of the unit step: the series of exp(s X) b exp(s X)^T to the sixth power, 1e-8 for |X| = 0.1.
Sym total_at(const BoyceDrive& drive, double s) {
  Sym term = drive.total, sum = term;
  for (int k = 1; k <= 6; ++k) {
    term = scaled(s / k, drag(drive.path, term));
    sum = combine(1, sum, 1, term);
  }
  return sum;
}

/// m^T m.
Sym own_square(const Mat& m) { return push(transposed(m), unit_sym); }

struct Middle {
  double mean = 1;    ///< tr(b_e)/3
  double modulus = 0; ///< Pa
};

/// One exponential step of b_e from `elastic`: f to its end, half to its middle.
struct Substep {
  const BergstroemBoyce& law;
  double dt;
  Mat half, whole;
  Sym half_square, whole_square; ///< C of the middle and of the end from the start

  /// C_v from the start's, x = relaxation number; a mean of positive definite tensors, then unimodular.
  static Sym relaxed(const Sym& viscous, const Sym& target, double mean, double x) {
    const Weights w = weights(x);
    return unimodular(combine(w.keep, viscous, 1 / mean, combine(w.start, unit_sym, w.end, target)));
  }
  /// The rate's number for the whole substep at its middle, if it relaxes by x in all.
  double number(const Sym& viscous, const Sym& total, double mean, double x, Middle& middle) const {
    const Sym v = relaxed(viscous, half_square, mean, 0.5 * x);
    const Sym b = push(half, inverse(v));
    const BoyceFlow flow = boyce_flow(law, dt, b, contract(v, total) / 3);
    middle = {trace(b) / 3, flow.modulus};
    return 2 * flow.number * middle.mean;
  }
};

/// Mean over a step of the square of a norm that goes from q0 to q1 as the relaxation x does.
double mean_square(double q0, double q1, const Relaxation& r) {
  const double d = (q1 - q0) / r.share;
  return q0 * q0 + 2 * q0 * d * r.first + d * d * r.second;
}

Sym network_stress(const BergstroemBoyce& m, const Sym& elastic) {
  return scaled(spring_modulus(m.b, trace(elastic)).value, deviator(elastic));
}

} // namespace

std::size_t state_count(const BergstroemBoyce&) { return 12; }

std::vector<std::string> state_names(const BergstroemBoyce&) {
  std::vector<std::string> names;
  append_tensor_names(names, "strain_b");
  append_tensor_names(names, "elastic_b");
  return names;
}

void set_rest(const BergstroemBoyce&, std::span<double> state) {
  for (std::size_t a = 0; a < 12; ++a) {
    state[a] = unit_sym[a % 6];
  }
}

double instant_shear(const BergstroemBoyce& m) { return m.a.shear + m.b.shear; }

double viscous_stretch(const Sym& total, const Sym& elastic) { return std::sqrt(contract(cofactor(elastic), total) / 3); }

double stored_energy(const BergstroemBoyce& m, const Sym& elastic) { return spring_energy(m.b, trace(elastic)); }

BoyceFlow boyce_flow(const BergstroemBoyce& m, double dt, const Sym& elastic, double stretch_square) {
  const SpringModulus spring = spring_modulus(m.b, trace(elastic));
  const double q = norm(deviator(elastic)), lam = std::sqrt(stretch_square), reach = lam - 1 + m.start;
  // (|s|/base)^m / |dev b_e| without dividing by what may be 0.
  const double ratio = spring.value / m.base;
  const double number = dt * m.rate * std::pow(reach, m.stretch_power) * ratio * std::pow(ratio * q, m.exponent - 1);
  return {number, spring.value, m.exponent - 1, spring.slope / spring.value, 0.5 * m.stretch_power / (reach * lam)};
}

// y' = X y + y X^T - 2 n (y^2 - t y), t = tr y / 3; dissipation n modulus |dev y|^2.
void rate(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const double* y, double* rate) {
  const Sym e = sym_of(y), q = deviator(e);
  const BoyceFlow flow = boyce_flow(m, drive.dt, e, contract(cofactor(e), total_at(drive, s)) / 3);
  const Sym carried = drag(drive.path, e), flows = scaled(0.5, drag(full(q), e));
  for (std::size_t a = 0; a < 6; ++a) {
    rate[a] = carried[a] - 2 * flow.number * flows[a];
  }
  rate[6] = flow.number * flow.modulus * contract(q, q);
}

void jacobian(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const double* y, BranchJacobian& out) {
  const Sym e = sym_of(y), q = deviator(e), total = total_at(drive, s);
  const BoyceFlow flow = boyce_flow(m, drive.dt, e, contract(cofactor(e), total) / 3);
  const Sym flows = scaled(0.5, drag(full(q), e)), stretch = scaled(1.0 / 3, mixed_cofactor(e, total));
  const double square = contract(q, q), mean = trace(e) / 3, heat = flow.number * flow.modulus;
  for (std::size_t b = 0; b < 6; ++b) {
    Sym unit{};
    unit[b] = 1;
    const double twice = b < 3 ? 1 : 2, trace_part = b < 3 ? 1 : 0;
    const double by_norm = square > 0 ? twice * q[b] / square : 0; // d ln |q|
    const double by_modulus = flow.by_trace * trace_part;
    const double log_number = flow.by_norm * by_norm + m.exponent * by_modulus + flow.by_square * twice * stretch[b];
    const Sym carried = drag(drive.path, unit), turned = drag(full(e), unit);
    for (std::size_t a = 0; a < 6; ++a) {
      out[6 * a + b] =
          carried[a] - 2 * flow.number * (turned[a] - mean * unit[a] - trace_part / 3 * e[a] + flows[a] * log_number);
    }
    out[36 + b] = heat * (square * (log_number + by_modulus) + 2 * twice * q[b]);
  }
}

double error_scale(const BergstroemBoyce& m, const double* y) {
  return std::max(norm(deviator(sym_of(y))), 0.01 * m.base / m.b.shear);
}

FastStep fast_step(const BergstroemBoyce& m, const BoyceDrive& drive, const Sym& y, int substeps) {
  Mat part = drive.path;
  for (double& x : part) {
    x /= 2 * substeps;
  }
  const Mat half = exponential(part), whole = product(half, half);
  const Substep sub{m, drive.dt / substeps, half, whole, own_square(half), own_square(whole)};
  const Sym strain = scaled(2, symmetric_part(part));
  FastStep step{{y, 0}, 0};
  Sym total = drive.total, stress = network_stress(m, y);
  double q = norm(deviator(y));
  for (int k = 0; k < substeps; ++k) {
    const Sym viscous = inverse(step.state.y);
    const double mean = trace(step.state.y) / 3;
    Middle middle;
    const double x = solve_relaxation([&](double guess) { return sub.number(viscous, total, mean, guess, middle); });
    const Sym end = push(whole, inverse(Substep::relaxed(viscous, sub.whole_square, middle.mean, x)));
    total = push(whole, total);
    const Relaxation r = relaxation(x);
    const double q_end = norm(deviator(end)), late = r.first / r.share;
    const Sym stress_end = network_stress(m, end);
    step.state.dissipated += 0.5 * x / middle.mean * middle.modulus * mean_square(q, q_end, r);
    step.work += (1 - late) * contract(stress, strain) + late * contract(stress_end, strain);
    step.state.y = end;
    stress = stress_end;
    q = q_end;
  }
  return step;
}

} // namespace ballast
