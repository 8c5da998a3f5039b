// Scenes with an exact solution: two uniform half-spaces that meet at a plane, of gases (Riemann problem) or of solids without
// strength at no pressure, the right one at rest (plate impact). Nothing else may start a wave: the sides along the way hold the
// matter between them, and what is at an end lets the state there be.
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

bool equal(double a, double b, double scale) {
  constexpr double rounding = 1e-9;
  return std::abs(a - b) <= rounding * std::abs(scale);
}

/// Why the side of the mesh beyond `h` starts a wave of its own; empty: it does not.
std::string wave_from_end(const SceneSpec& s, const Half& h, int axis, int side) {
  const Boundary& b = s.boundaries[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
  const double u = h.velocity[static_cast<std::size_t>(axis)], away = side == 0 ? u : -u; // away from the end
  const double e = h.body < 0 ? h.material->specific_energy : s.bodies[static_cast<std::size_t>(h.body)].specific_energy;
  const double c2 = sound_speed_squared(h.material->eos, h.density, e), stiffness = h.density * c2;
  const bool at_ambient = equal(h.pressure, s.ambient_pressure, stiffness);
  const std::string pressures = fmt::format("{:g} Pa beside an ambient pressure of {:g} Pa", h.pressure, s.ambient_pressure);
  switch (b.kind) {
  case BoundaryKind::symmetry:
  case BoundaryKind::wall: {
    const double wall = b.kind == BoundaryKind::wall ? b.wall_velocity : 0;
    return equal(u, wall, std::sqrt(c2)) ? "" : fmt::format("matter at {:g} m/s at a wall at {:g} m/s", u, wall);
  }
  case BoundaryKind::free:
    if (!at_ambient) {
      return pressures;
    }
    return away > 0 && !sides_go_along(s.motion) ? fmt::format("matter leaves a free side at {:g} m/s and void comes after it", away) : "";
  case BoundaryKind::absorbing:
    return !at_ambient ? pressures : u != 0 ? fmt::format("matter at {:g} m/s beside an absorbing side, behind which it rests", u) : "";
  case BoundaryKind::inflow: {
    const bool same = &s.materials[static_cast<std::size_t>(b.material)] == h.material && b.velocity == h.velocity &&
                      equal(b.density, h.density, h.density) && equal(b.pressure, h.pressure, stiffness);
    return same ? "" : "what comes in is of another state";
  }
  case BoundaryKind::outflow:
    break;
  }
  return "";
}

/// What of the scene but the plane between the halves starts waves or matter moving; empty: nothing.
std::string disturbed_by(const SceneSpec& s, const Halves& h) {
  for (const Half* half : {&h.left, &h.right}) {
    if (half->body >= 0 && s.bodies[static_cast<std::size_t>(half->body)].radial) {
      return fmt::format("body \"{}\" has a radial velocity: it is not uniform", s.bodies[static_cast<std::size_t>(half->body)].name);
    }
  }
  if (s.motion.policy == MotionPolicy::follow) {
    return "the ends of a mesh that follows bodies go where these go";
  }
  const std::vector<std::string> names = axis_names(s.geometry);
  for (int axis = 0; axis < dimensions(s.geometry); ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Boundary& b = s.boundaries[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
      const std::string place = fmt::format("{} side of {}", side == 0 ? "lower" : "upper", names[static_cast<std::size_t>(axis)]);
      const bool holds = b.kind == BoundaryKind::symmetry || (b.kind == BoundaryKind::wall && b.wall_velocity == 0);
      if (axis != h.axis && !holds) {
        return fmt::format("the {} is along the flow and neither a plane of symmetry nor a wall at rest", place);
      }
      const std::string wave = axis == h.axis ? wave_from_end(s, side == 0 ? h.left : h.right, axis, side) : "";
      if (!wave.empty()) {
        return fmt::format("a wave starts at the {} at once: {}", place, wave);
      }
    }
  }
  return "";
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

/// When the outermost waves reach the ends of the mesh, which may go along with the matter there.
double reached_at(const SceneSpec& s, const Halves& h, double left_speed, double right_speed) {
  const auto axis = static_cast<std::size_t>(h.axis);
  const auto& line = s.mesh_lines[axis];
  left_speed -= sides_go_along(s.motion) ? h.left.velocity[axis] : 0;
  right_speed -= sides_go_along(s.motion) ? h.right.velocity[axis] : 0;
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
    if (why_not = disturbed_by(s, *h); !why_not.empty()) {
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
