#include "materials/visco_bergstroem_boyce.hpp"

#include <algorithm>

namespace ballast {

namespace {

/// Flow at a state: its number and derivatives.
struct Flow {
  double number;    ///< dt gdot / |dev b_e|
  double modulus;   ///< of network B, Pa
  double by_trace;  ///< d ln modulus / d tr b_e
  double by_square; ///< d ln number / d lam_v^2
};

Flow flow_at(const BergstroemBoyce& m, double dt, double q, double elastic_trace, double stretch_square) {
  const SpringModulus spring = spring_modulus(m.b, elastic_trace);
  const double lam = std::sqrt(stretch_square), reach = lam - 1 + m.start;
  // (|s|/base)^m / |dev b_e| without dividing by what may be 0.
  const double ratio = spring.value / m.base;
  const double number = dt * m.rate * std::pow(reach, m.stretch_power) * ratio * std::pow(ratio * q, m.exponent - 1);
  return {number, spring.value, spring.slope / spring.value, 0.5 * m.stretch_power / (reach * lam)};
}

/// What CVODE's variables say of the elastic strain: m = v^-1 C is similar to b_e.
struct Elastic {
  Sym c, inverse;
  Mat m;
  double mean;   ///< t
  double square; ///< |dev b_e|^2
};

Elastic elastic_of(const BoyceDrive& drive, double s, const Sym& v) {
  Elastic e;
  e.c = drive.square[6];
  for (std::size_t k = 6; k-- > 0;) {
    e.c = combine(s, e.c, 1, drive.square[k]);
  }
  e.inverse = inverse(v);
  e.m = product(full(e.inverse), full(e.c));
  e.mean = (e.m[0] + e.m[4] + e.m[8]) / 3;
  const Mat q = without_trace(e.m);
  e.square = std::max(0.0, q[0] * q[0] + q[4] * q[4] + q[8] * q[8] + 2 * (q[1] * q[3] + q[2] * q[6] + q[5] * q[7]));
  return e;
}

Flow flow_at(const BergstroemBoyce& m, const BoyceDrive& drive, const Elastic& e, const Sym& v) {
  return flow_at(m, drive.dt, std::sqrt(e.square), 3 * e.mean, contract(v, drive.total) / 3);
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
    const Flow flow = flow_at(law, dt, norm(deviator(b)), trace(b), contract(v, total) / 3);
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

double elastic_number(const BergstroemBoyce& m, const BoyceDrive& drive, const Sym& y) {
  const Sym end = push(exponential(drive.path), y);
  const double stretch_square = contract(cofactor(y), drive.total) / 3; // elastic motion leaves it
  const double start_mean = trace(y) / 3, end_mean = trace(end) / 3;
  return 2 * std::max(start_mean * flow_at(m, drive.dt, norm(deviator(y)), 3 * start_mean, stretch_square).number,
                      end_mean * flow_at(m, drive.dt, norm(deviator(end)), 3 * end_mean, stretch_square).number);
}

double error_scale(const BergstroemBoyce& m, const Sym& y) { return std::max(norm(deviator(y)), 0.01 * m.base / m.b.shear); }

void prepare(BoyceDrive& drive) {
  const Mat back = transposed(drive.path);
  drive.square[0] = unit_sym;
  for (std::size_t k = 1; k < drive.square.size(); ++k) {
    drive.square[k] = scaled(1.0 / static_cast<double>(k), drag(back, drive.square[k - 1]));
  }
}

Sym to_variables(const BoyceDrive&, const Sym& elastic) { return inverse(elastic); }

Sym from_variables(const BoyceDrive& drive, double s, const Sym& v) {
  Mat path = drive.path;
  for (double& x : path) {
    x *= s;
  }
  return unimodular(push(exponential(path), inverse(v)));
}

void rate(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const Sym& v, Sym& rate, double& heat) {
  const Elastic e = elastic_of(drive, s, v);
  const Flow flow = flow_at(m, drive, e, v);
  rate = scaled(2 * flow.number, combine(1, e.c, -e.mean, v));
  heat = flow.number * flow.modulus * e.square;
}

// With p = v^-1 C v^-1: dt = -p:dv/3 and d|dev b_e|^2 = -2 (m - t) p : dv.
void jacobian(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const Sym& v, BranchJacobian& out) {
  const Elastic e = elastic_of(drive, s, v);
  const Flow flow = flow_at(m, drive, e, v);
  const Mat p = product(e.m, full(e.inverse));
  const Sym by_mean = by_variables(scaled(-1.0 / 3, symmetric_part(p)));
  const Sym by_square = by_variables(scaled(-2, symmetric_part(product(without_trace(e.m), p))));
  const double steep = e.square > 0 ? 0.5 * (m.exponent - 1) / e.square : 0;
  const Sym log_number = combine(1, combine(steep, by_square, 3 * m.exponent * flow.by_trace, by_mean),
                                 flow.by_square / 3, by_variables(drive.total));
  const double heat = flow.number * flow.modulus;
  out.diagonal = -2 * flow.number * e.mean;
  out.left = {scaled(2 * flow.number, combine(1, e.c, -e.mean, v)), scaled(-2 * flow.number, v)};
  out.right = {log_number, by_mean};
  out.heat = scaled(heat, combine(1, combine(e.square, log_number, 3 * e.square * flow.by_trace, by_mean), 1, by_square));
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
