// Spall of OFHC copper: a pulse at a free face, a flyer on a plate.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"

#include <algorithm>
#include <cmath>

namespace ballast::verify {

namespace {

constexpr double spall_cell = 0.05e-3;

/// A row of copper cells, free of stress at both ends; eulerian: with void beside it for it to move into.
struct SpallBar {
  MotionPolicy motion;
  bool strength;
  double length, room, end_time; ///< m, of void ahead, s
};

Scene<2> bar_at_rest(const SpallBar& p) {
  SceneSpec s;
  Material copper = copper_at_zero();
  if (!p.strength) {
    copper.strength = NoStrength{};
  }
  s.ambient_pressure = 0;
  s.end_time = p.end_time;
  s.materials = {copper};
  s.motion = {p.motion, 1};
  s.energy_return = p.strength ? Switch::automatic : Switch::off;
  const bool lagrangian = p.motion == MotionPolicy::lagrangian;
  const auto behind = lagrangian ? 0 : 10L;
  const auto cells = std::lround((p.length + (lagrangian ? 0 : p.room)) / spall_cell) + behind;
  for (long i = 0; i <= cells; ++i) {
    s.mesh_lines[0].push_back(static_cast<double>(i - behind) * spall_cell);
  }
  s.mesh_lines[1] = {0, spall_cell};
  s.bodies.push_back({"copper", 0, Shape{Box{{0, -1, -1}, {p.length, 1, 1}}}, {0, 0, 0}, copper.density, 0, copper.specific_energy});
  s.boundaries[0][0].kind = s.boundaries[0][1].kind = BoundaryKind::free;
  s.boundaries[1][0].kind = s.boundaries[1][1].kind = BoundaryKind::symmetry;
  return build_scene<2>(s, 1);
}

/// The opening in the copper.
struct Gap {
  double width = 0; ///< void more than four cells below the faces, m
  double scab = 0;  ///< copper right of the widest opening, thickness at rest, m
  double scab_velocity = 0, rest_velocity = 0;
};

Gap gap_of(const Block<2>& b) {
  const int r = b.grid.cell_row(0, 0), n = b.grid.node_row(0, 0);
  const MaterialSlot& copper = b.materials[0];
  const double *f = copper.store.row(field::fraction, r), *m = copper.store.row(field::mass, r), *v = b.volume.row(r);
  const double area = b.position[1].row(b.grid.node_row(1, 0))[0] - b.position[1].row(n)[0];
  int first = 0, last = b.grid.cells[0] - 1;
  for (; first < last && f[first] == 0; ++first) {
  }
  for (; last > first && f[last] == 0; --last) {
  }
  first += 5;
  last -= 5;
  Gap g;
  int widest = first;
  for (int i = first; i <= last; ++i) {
    g.width += (1 - f[i]) * v[i] / area;
    widest = (1 - f[i]) * v[i] > (1 - f[widest]) * v[widest] ? i : widest;
  }
  double mass[2] = {0, 0}, momentum[2] = {0, 0};
  const double* u = b.velocity[0].row(n);
  for (int i = 0; i < b.grid.cells[0]; ++i) {
    for (int side = 0; side < 2; ++side) { // the widest cell's own copper hangs half on either side
      const double part = i == widest ? 0.5 : (i > widest) == (side == 1) ? 1 : 0;
      mass[side] += part * m[i];
      momentum[side] += part * m[i] * 0.5 * (u[i] + u[i + 1]);
    }
  }
  g.scab = mass[1] / (area * copper.material.density);
  g.rest_velocity = momentum[0] / mass[0];
  g.scab_velocity = momentum[1] / mass[1];
  return g;
}

/// Velocity of the rear face and the gap, step by step, and where the copper opened first.
class SpallWatch : public Observer<2> {
public:
  struct Point {
    double time, velocity, gap;
  };

  bool record(const Scene<2>& scene, const Clock& clock) override {
    const Block<2>& b = scene.blocks[0];
    const std::int8_t* owner = b.owner_row(b.grid.cell_row(0, 0));
    int i = b.grid.cells[0] - 1;
    for (; i > 0 && owner[i] != 0; --i) {
    }
    const Gap g = gap_of(b);
    if (g.width > 0 && first_time_ == 0) {
      first_time_ = clock.time;
      first_scab_ = g.scab;
    }
    history_.push_back({clock.time, b.velocity[0].row(b.grid.node_row(0, 0))[i + 1], g.width});
    return true;
  }
  double first_time() const { return first_time_; }
  double first_scab() const { return first_scab_; }
  double greatest() const {
    double v = 0;
    for (const Point& p : history_) {
      v = std::max(v, p.velocity);
    }
    return v;
  }
  /// Least rear velocity in [from, to].
  double least(double from, double to) const {
    double v = std::numeric_limits<double>::infinity();
    for (const Point& p : history_) {
      v = p.time >= from && p.time <= to ? std::min(v, p.velocity) : v;
    }
    return v;
  }
  /// Mean by time of the rear velocity in [from, to].
  double mean(double from, double to) const {
    double sum = 0, time = 0;
    for (std::size_t i = 1; i < history_.size(); ++i) {
      if (history_[i].time >= from && history_[i].time <= to) {
        sum += history_[i].velocity * (history_[i].time - history_[i - 1].time);
        time += history_[i].time - history_[i - 1].time;
      }
    }
    return sum / time;
  }
  double gap(double time) const {
    const auto at = std::find_if(history_.begin(), history_.end(), [&](const Point& p) { return p.time >= time; });
    return at == history_.end() ? history_.back().gap : at->gap;
  }
  /// By how much the gap ever fell below what it had been.
  double shrinkage() const {
    double widest = 0, worst = 0;
    for (const Point& p : history_) {
      widest = std::max(widest, p.gap);
      worst = std::max(worst, widest - p.gap);
    }
    return worst;
  }

private:
  std::vector<Point> history_;
  double first_time_ = 0, first_scab_ = 0;
};

/// The void does not heal: the gap does not shrink by more than a tenth of a cell (pieces that ring), and in
/// both halves of the time from `from` on it widens at the speed at which the pieces part, within the ringing of
/// that speed.
void parts(VerifyReport& r, const std::string& name, const SpallWatch& watch, const TubeRun<2>& run, double from) {
  const double end = run.clock.time, middle = 0.5 * (from + end);
  const Gap g = gap_of(run.scene.blocks[0]);
  const double speed = g.scab_velocity - g.rest_velocity;
  r.note(name + ", pieces part at the end at", speed);
  r.at_least(name + ", gap widens, first half", 0.8 * speed * (middle - from), watch.gap(middle) - watch.gap(from));
  r.at_least(name + ", gap widens, second half", 0.8 * speed * (end - middle), watch.gap(end) - watch.gap(middle));
  r.at_most(name + ", gap shrinks / cell", 0.1, watch.shrinkage() / spall_cell);
  r.note(name + ", cells opened", static_cast<double>(run.scene.ledger.spalled_cells));
}

/// A pulse that falls to zero over `pulse` behind its peak comes back from the free face as tension (it rises
/// over `rise` ahead of it: a jump would ring as it is released). Acoustics: tension p_s is reached first at d = pulse p_s / 2P from the face, a time d/c after
/// the peak arrived; the face has then slowed by 2 p_s / (rho0 c) when the opening's wave comes to it.
void spall_ramp(VerifyReport& r) {
  constexpr double pulse = 8e-3, rise = 1e-3, length = 12e-3;
  const Material copper = copper_at_zero();
  const auto& eos = std::get<MieGruneisen>(copper.eos);
  const double ps = -copper.spall_pressure, peak = 1.5 * ps, impedance = copper.density * eos.c0;
  const double depth = pulse * ps / (2 * peak), arrival = rise / eos.c0, end = 5e-6;
  double gap = 0;
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Scene<2> scene = bar_at_rest({motion, false, length, 0.5e-3, end});
    Block<2>& b = scene.blocks[0];
    const auto strength_of = [&](double x) {
      const double behind = length - rise - x;
      return x < 0 || x > length ? 0 : std::max(0.0, 1 - (behind > 0 ? behind / pulse : -behind / rise));
    };
    const int row = b.grid.cell_row(0, 0);
    for (int i = 0; i < b.grid.cells[0]; ++i) {
      const double x = 0.5 * (b.target[0].row(b.grid.node_row(0, 0))[i] + b.target[0].row(b.grid.node_row(0, 0))[i + 1]);
      if (const double p = peak * strength_of(x); p > 0) {
        // On the wave's own adiabat: d rho = rho0 u / c, d e = p^2 / (2 rho0^2 c^2).
        const double u = p / impedance, rho = copper.density / (1 - u / (eos.c0 + eos.s * u));
        b.materials[0].store.row(field::mass, row)[i] = rho * b.volume.row(row)[i];
        b.materials[0].store.row(field::energy, row)[i] = copper.specific_energy + 0.5 * u * u;
      }
    }
    set_velocity(b, [&](const std::array<double, 2>& x, std::array<double, 2>& u) { u[0] = peak * strength_of(x[0]) / impedance; });
    SpallWatch watch;
    const TubeRun<2> run = run_scene<2>(std::move(scene), end, {&watch});
    const std::string name = short_name(motion);
    r.close(name + ", depth of the spall", depth, 3 * spall_cell / depth, watch.first_scab());
    r.close(name + ", time of the spall", arrival + depth / eos.c0, 0.1, watch.first_time());
    const double slowed = watch.greatest() - watch.least(arrival + depth / eos.c0, arrival + 3 * depth / eos.c0);
    r.close(name + ", rear face at the peak", 2 * peak / impedance, 0.1, watch.greatest());
    r.close(name + ", pull-back", 2 * ps / impedance, 0.1, slowed);
    parts(r, name, watch, run, 3e-6);
    r.at_most(name + ", voids closed", 0, static_cast<double>(run.scene.ledger.closed_voids));
    if (motion == MotionPolicy::lagrangian) {
      gap = gap_of(run.scene.blocks[0]).width;
    } else {
      r.close(name + " as Lag, gap", gap, 0.05, gap_of(run.scene.blocks[0]).width);
    }
    conserves(r, name, run);
  }
  r.set_cells(static_cast<long>(std::lround(length / spall_cell)));
}

/// Where two plates open first, as depth from the rear face (material coordinate). Acoustics: the flyer's thickness.
/// At finite amplitude both faces send centred fans, of speeds from c0 + 2 s u (head) to c0 (tail), and p_s is
/// reached first where the whole rear fan meets the part p_s / p of the flyer's.
double first_opening(const MieGruneisen& eos, double flyer, double target, double u, double share) {
  const double shock = eos.c0 + eos.s * u, head = eos.c0 + 2 * eos.s * u * (1 - share);
  const double start = flyer / shock, rear = target / shock;
  const double time = (flyer + target + head * start + eos.c0 * rear) / (head + eos.c0);
  return eos.c0 * (time - rear);
}

/// A 2 mm flyer on a 4 mm target. The face runs at the flyer's speed before it is pulled back.
void spall_plate(VerifyReport& r) {
  constexpr double flyer = 2e-3, target = 4e-3, speed = 300, end = 4e-6;
  const Material copper = copper_at_zero();
  const auto& eos = std::get<MieGruneisen>(copper.eos);
  struct Result {
    double pull_back, gap, parting;
  } reference{};
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Scene<2> scene = bar_at_rest({motion, true, flyer + target, 1.5e-3, end});
    set_velocity(scene.blocks[0], [&](const std::array<double, 2>& x, std::array<double, 2>& u) {
      const double tiny = 1e-9;
      u[0] = x[0] < flyer - tiny && x[0] > -tiny ? speed : x[0] < flyer + tiny && x[0] > -tiny ? 0.5 * speed : 0;
    });
    SpallWatch watch;
    const TubeRun<2> run = run_scene<2>(std::move(scene), end, {&watch});
    const std::string name = short_name(motion);
    const double shock = eos.c0 + eos.s * 0.5 * speed, arrival = target / shock;
    const double plateau = watch.mean(arrival + 0.3e-6, arrival + 0.7e-6);
    r.close(name + ", rear face before the pull-back", speed, 0.02, plateau);
    const double pressure = copper.density * shock * 0.5 * speed;
    const double depth = first_opening(eos, flyer, target, 0.5 * speed, -copper.spall_pressure / pressure);
    r.close(name + ", depth of the spall", depth, 3 * spall_cell / depth, watch.first_scab());
    r.note(name + ", depth of the spall / acoustic", watch.first_scab() / flyer);
    const Result got{plateau - watch.least(arrival + 0.7e-6, arrival + 1.7e-6), gap_of(run.scene.blocks[0]).width,
                     gap_of(run.scene.blocks[0]).scab_velocity - gap_of(run.scene.blocks[0]).rest_velocity};
    // The tail of the pulse is 2 cells wide at the spall pressure and the opening's wave is elastic, a fifth
    // faster: it eats most of what acoustics, 2 p_s / (rho0 c), would give. The law itself: spall_ramp.
    r.note(name + ", pull-back", got.pull_back);
    r.note(name + ", pull-back / acoustic", got.pull_back / (-2 * copper.spall_pressure / (copper.density * eos.c0)));
    parts(r, name, watch, run, 2e-6);
    if (motion == MotionPolicy::lagrangian) {
      reference = got;
    } else {
      r.close(name + " as Lag, pull-back", reference.pull_back, 0.1, got.pull_back);
      r.close(name + " as Lag, gap", reference.gap, 0.05, got.gap);
      r.close(name + " as Lag, speed of parting", reference.parting, 0.1, got.parting);
    }
    r.note(name + ", voids closed", static_cast<double>(run.scene.ledger.closed_voids));
    conserves(r, name, run);
  }
  r.set_cells(static_cast<long>(std::lround((flyer + target) / spall_cell)));
}

} // namespace

void add_spall_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"spall_ramp", "triangular pulse at a free face: depth of spall, pull-back 2 p_s/(rho0 c), no healing", spall_ramp});
  cases.push_back({"spall_plate", "copper flyer on copper: spall as deep as the flyer is thick, Eulerian as Lagrangian, no healing",
                   spall_plate});
}

} // namespace ballast::verify
