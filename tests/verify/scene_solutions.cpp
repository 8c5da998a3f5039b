// Scenes with an exact solution: two uniform half-spaces that meet at a plane, of gases (Riemann problem) or of solids without
// strength at no pressure, the right one at rest (plate impact).
#include "problems/exact_solution.hpp"
#include "tests/exact/mie_gruneisen_impact.hpp"
#include "tests/exact/riemann.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

namespace {

/// What one half of the scene holds.
struct Half {
  int body = -1; ///< -1: the background
  const Material* material = nullptr;
  double density = 0, pressure = 0;
  Point velocity{};
};

struct Halves {
  int axis = 0;
  double interface = 0;
  Half left, right;
};

std::optional<Half> half_of(const SceneSpec& s, int body) {
  Half h{body};
  const int material = body < 0 ? s.background : s.bodies[static_cast<std::size_t>(body)].material;
  if (material < 0) {
    return std::nullopt;
  }
  h.material = &s.materials[static_cast<std::size_t>(material)];
  h.density = body < 0 ? h.material->density : s.bodies[static_cast<std::size_t>(body)].density;
  const double e = body < 0 ? h.material->specific_energy : s.bodies[static_cast<std::size_t>(body)].specific_energy;
  h.pressure = pressure(h.material->eos, h.density, e);
  if (body >= 0) {
    h.velocity = s.bodies[static_cast<std::size_t>(body)].velocity;
  }
  return h;
}

/// The only body of a stretch along `axis` (-1: background), or none.
std::optional<int> sole_body(const SceneSpec& s, int axis, double from, double to) {
  Point lo{}, hi{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto& line = s.mesh_lines[d];
    lo[d] = line.empty() ? 0 : line.front();
    hi[d] = line.empty() ? 0 : line.back();
  }
  lo[static_cast<std::size_t>(axis)] = from;
  hi[static_cast<std::size_t>(axis)] = to;
  std::vector<double> shares(s.bodies.size());
  body_fractions(s, lo, hi, shares);
  constexpr double whole = 1 - 1e-12;
  double left = 1;
  for (std::size_t q = 0; q < shares.size(); ++q) {
    if (shares[q] >= whole) {
      return static_cast<int>(q);
    }
    left -= shares[q];
  }
  return left >= whole ? std::optional(-1) : std::nullopt;
}

/// Two bodies with a plane across `axis` between them, found by bisection.
std::optional<Halves> halves_of(const SceneSpec& s, int axis) {
  const auto& line = s.mesh_lines[static_cast<std::size_t>(axis)];
  const std::size_t n = line.size() - 1;
  const auto first = sole_body(s, axis, line[0], line[1]), last = sole_body(s, axis, line[n - 1], line[n]);
  if (n < 2 || !first || !last || *first == *last) {
    return std::nullopt;
  }
  double low = line[0], high = line[n];
  constexpr int halvings = 60;
  for (int q = 0; q < halvings; ++q) {
    const double middle = 0.5 * (low + high);
    (sole_body(s, axis, line[0], middle) == first ? low : high) = middle;
  }
  const double width = line[n] - line[0];
  if (sole_body(s, axis, high + 1e-9 * width, line[n]) != last) {
    return std::nullopt;
  }
  const auto left = half_of(s, *first), right = half_of(s, *last);
  if (!left || !right) {
    return std::nullopt;
  }
  return Halves{axis, low, *left, *right};
}

bool only_along(const Point& velocity, int axis) {
  for (int d = 0; d < 3; ++d) {
    if (d != axis && velocity[static_cast<std::size_t>(d)] != 0) {
      return false;
    }
  }
  return true;
}

std::optional<exact::GasState> gas_of(const Half& h, int axis) {
  const double u = h.velocity[static_cast<std::size_t>(axis)];
  if (const auto* gas = std::get_if<IdealGas>(&h.material->eos)) {
    return exact::GasState{h.density, u, h.pressure, gas->gamma, 0};
  }
  if (const auto* gas = std::get_if<StiffenedGas>(&h.material->eos)) {
    return exact::GasState{h.density, u, h.pressure, gas->gamma, gas->p_infinity};
  }
  return std::nullopt;
}

/// When the outermost waves reach the ends of the mesh.
double reached_at(const SceneSpec& s, const Halves& h, double left_speed, double right_speed) {
  const auto& line = s.mesh_lines[static_cast<std::size_t>(h.axis)];
  const double left = left_speed < 0 ? (line.front() - h.interface) / left_speed : std::numeric_limits<double>::infinity();
  const double right = right_speed > 0 ? (line.back() - h.interface) / right_speed : std::numeric_limits<double>::infinity();
  return std::min(left, right);
}

ExactSolution riemann_solution(const SceneSpec& s, const Halves& h, const exact::GasState& left, const exact::GasState& right) {
  const exact::Riemann riemann(left, right);
  return {"Riemann problem of two gases", h.axis, reached_at(s, h, riemann.waves().left_head, riemann.waves().right_head),
          [riemann, left, right, x0 = h.interface](double x, double t) {
            if (t <= 0) {
              const exact::GasState& g = x < x0 ? left : right;
              return ExactState{g.density, g.velocity, g.pressure};
            }
            const auto q = riemann.at((x - x0) / t);
            return ExactState{q.density, q.velocity, q.pressure};
          }};
}

std::optional<exact::LinearHugoniot> solid_of(const Half& h) {
  const auto* mg = std::get_if<MieGruneisen>(&h.material->eos);
  const double none = mg ? 1e-9 * mg->rho0 * mg->c0 * mg->c0 : 0;
  if (mg == nullptr || has_strength(h.material->strength) || std::abs(h.pressure) > none || h.density != mg->rho0) {
    return std::nullopt;
  }
  return exact::LinearHugoniot{mg->rho0, mg->c0, mg->s, mg->gamma0};
}

ExactSolution impact_solution(const SceneSpec& s, const Halves& h, const exact::LinearHugoniot& flyer, const exact::LinearHugoniot& target) {
  const auto axis = static_cast<std::size_t>(h.axis);
  const double drift = h.right.velocity[axis];
  const exact::PlateImpact impact(flyer, target, h.left.velocity[axis] - drift);
  const exact::ImpactStates& states = impact.states();
  return {"plate impact without strength", h.axis, reached_at(s, h, states.flyer_shock_velocity + drift, states.target_shock_velocity + drift),
          [impact, flyer, target, drift, v = h.left.velocity[axis], x0 = h.interface](double x, double t) {
            if (t <= 0) {
              return x < x0 ? ExactState{flyer.density, v, 0} : ExactState{target.density, drift, 0};
            }
            const exact::FlowState q = impact.at((x - x0) / t - drift);
            return ExactState{q.density, q.velocity + drift, q.pressure};
          }};
}

} // namespace

std::optional<ExactSolution> exact_solution_of(const SceneSpec& s, std::string& why_not) {
  if (s.geometry == Geometry::axisymmetric) {
    why_not = "exact solutions are known of planar and 3d scenes only";
    return std::nullopt;
  }
  if (s.map.curved()) {
    why_not = "exact solutions are known on rectilinear meshes only";
    return std::nullopt;
  }
  for (int axis = 0; axis < dimensions(s.geometry); ++axis) {
    const auto h = halves_of(s, axis);
    if (!h) {
      continue;
    }
    if (!only_along(h->left.velocity, axis) || !only_along(h->right.velocity, axis)) {
      why_not = "the halves slip along each other";
      return std::nullopt;
    }
    std::optional<ExactSolution> found;
    const auto gas_left = gas_of(h->left, axis), gas_right = gas_of(h->right, axis);
    const auto solid_left = solid_of(h->left), solid_right = solid_of(h->right);
    if (gas_left && gas_right) {
      found = riemann_solution(s, *h, *gas_left, *gas_right);
    } else if (solid_left && solid_right && h->left.velocity[static_cast<std::size_t>(axis)] > h->right.velocity[static_cast<std::size_t>(axis)]) {
      found = impact_solution(s, *h, *solid_left, *solid_right);
    } else {
      why_not = "an exact solution is known of two ideal or stiffened gases, or of two Mie-Grueneisen materials without strength that collide at no pressure";
      return std::nullopt;
    }
    if (s.end_time > found->valid_until) {
      why_not = fmt::format("a wave reaches an end of the mesh at {:g} s, before end_time", found->valid_until);
      return std::nullopt;
    }
    return found;
  }
  why_not = "the scene is not two uniform halves that meet at a plane across a mesh axis";
  return std::nullopt;
}

} // namespace ballast
