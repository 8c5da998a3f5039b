// A beryllium plate vibrates freely in its first bending mode, plane strain, twenty periods. The frequency is that of a fine
// finite-element eigenvalue (2D, quadratic, 96 x 16: omega_FEM); beam theory is 8 % off for this plate.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <vector>

namespace ballast::verify {

namespace {

// Row beryllium_c0_7998 of the reference table: 6 x 1 cm, rho 1845, G 151.9 GPa, K = rho c0^2 with c0 = 7998 m/s.
constexpr double plate_length = 0.06, plate_height = 0.01, omega = 217471.163963;
constexpr double period = 2 * std::numbers::pi / omega;
constexpr double tip_speed = 10; // m/s; the tip moves by tip_speed / omega = 46 um, 1/200 of the height

/// Free-free first mode of a beam, 2 at the ends: beta L = 4.7300407448627.
double mode(double x) {
  constexpr double s = 0.982502214576238, beta = 4.7300407448627;
  const double q = beta * x / plate_length;
  return std::cosh(q) + std::cos(q) - s * (std::sinh(q) + std::sin(q));
}

/// Modal velocity step by step: sum m v_y phi / sum m phi^2.
class ModeWatch : public Observer<2> {
public:
  bool record(const Scene<2>& scene, const Clock& clock) override {
    const Block<2>& b = scene.blocks[0];
    double sum = 0, norm = 0;
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      const int r = b.grid.node_row(j, 0);
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        const double phi = mode(plate_length * i / b.grid.cells[0]), m = b.node_mass.row(r)[i];
        sum += m * b.velocity[1].row(r)[i] * phi;
        norm += m * phi * phi;
      }
    }
    const double now = sum / norm;
    if (before_ < 0 && now >= 0) {
      upward_.push_back(time_ + (clock.time - time_) * before_ / (before_ - now));
    }
    before_ = now;
    time_ = clock.time;
    // Peaks of each whole period, for what is left of the amplitude.
    const auto period = static_cast<std::size_t>(clock.time * omega / (2 * std::numbers::pi));
    peaks_.resize(std::max(peaks_.size(), period + 1), 0.0);
    peaks_[period] = std::max(peaks_[period], std::abs(now));
    return true;
  }
  /// Mean over all whole periods seen.
  double period() const { return (upward_.back() - upward_.front()) / static_cast<double>(upward_.size() - 1); }
  std::size_t periods() const { return upward_.size() - 1; }
  double first_peak() const { return peaks_[1]; }
  double last_peak() const { return peaks_[peaks_.size() - 2]; }

private:
  std::vector<double> upward_, peaks_;
  double before_ = 0, time_ = 0;
};

Scene<2> plate(int across) {
  Material beryllium;
  beryllium.name = "beryllium";
  beryllium.eos = MieGruneisen{1845, 7998, 1.124, 1.11, true};
  beryllium.strength = LinearHardening{151.9e9, std::numeric_limits<double>::infinity(), 0};
  beryllium.density = 1845;
  Block<2> b;
  b.motion = {MotionPolicy::lagrangian, 1};
  b.materials.push_back(make_slot(beryllium, 0));
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i <= 6 * across; ++i) {
    lines[0].push_back(plate_length * i / (6 * across));
  }
  for (int j = 0; j <= across; ++j) {
    lines[1].push_back(plate_height * j / across);
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) { fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, 1, 1845, 0}}); });
  set_velocity(b, [](const std::array<double, 2>& x, std::array<double, 2>& u) { u[1] = 0.5 * tip_speed * mode(x[0]); });
  for (std::size_t d = 0; d < 2; ++d) {
    b.boundary.side[d].fill({BoundaryKind::free, 0});
  }
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  return scene;
}

struct Ringing {
  double frequency, left; ///< rad/s; amplitude after 19 periods, of that in the second
  TubeRun<2> run;
};

Ringing ring(int across, const Numerics& numerics) {
  ModeWatch watch;
  Scene<2> scene = plate(across);
  scene.numerics = numerics;
  Ringing out{0, 0, run_scene<2>(std::move(scene), 21.2 * period, {&watch})};
  out.frequency = watch.periods() >= 20 ? 2 * std::numbers::pi / watch.period() : 0;
  out.left = watch.last_peak() / watch.first_peak();
  return out;
}

/// Gates where the plate is 12 cells high. What the vibration loses is reported, and by which term: the energy itself is kept (it is
/// heat then).
void vibration(VerifyReport& r) {
  Numerics no_viscosity, no_hourglass;
  no_viscosity.linear_q = no_viscosity.quadratic_q = 0;
  no_hourglass.hourglass = 0;
  const Ringing coarse = ring(6, {}), fine = ring(12, {});
  r.note("36 x 6, frequency / exact - 1", coarse.frequency / omega - 1);
  r.close("72 x 12, frequency (rad/s)", omega, 0.01, fine.frequency);
  r.note("order of the frequency", std::log2((coarse.frequency / omega - 1) / (fine.frequency / omega - 1)));
  conserves(r, "72 x 12", fine.run);
  r.note("36 x 6, amplitude left after 19 periods", coarse.left);
  r.note("72 x 12, amplitude left after 19 periods", fine.left);
  r.note("72 x 12, without viscosity", ring(12, no_viscosity).left);
  r.note("72 x 12, without hourglass control", ring(12, no_hourglass).left);
  r.note("72 x 12, steps", static_cast<double>(fine.run.clock.step));
  r.set_cells(72 * 12);
}

} // namespace

void add_vibration_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"vibrating_plate", "first bending mode of a beryllium plate, twenty periods", vibration});
}

} // namespace ballast::verify
