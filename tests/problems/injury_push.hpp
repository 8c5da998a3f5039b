// A block that is pushed along the shot by hand, by a known force, and what its record says.
#pragma once

#include "problems/build_scene.hpp"
#include "problems/injury_values.hpp"
#include "tests/problems/injury_scenes.hpp"

#include <cmath>
#include <numbers>

namespace ballast::injury_scenes {

/// Its acceleration along the shot is `height` sin^2 from `begin` on for `length`; before and after it flies freely.
template <int Dim> class Push {
public:
  static constexpr double height = 1000, begin = 5e-3, length = 20e-3, middle = begin + 0.5 * length; // m/s2, s

  Push(const std::string& text, double direction, double until)
      : read_(read_text(folder_, text, {"injury.record_every=10 us", direction > 0 ? "injury.direction=+z" : "injury.direction=-z"})), scene_(build_scene<Dim>(read_.scene, 1)),
        record_(read_.scene, slot_map(read_.scene).slot) {
    std::vector<double> gauges(read_.scene.gauges.front().at.begin(), read_.scene.gauges.front().at.end());
    const auto axis = static_cast<std::size_t>(Dim - 1);
    constexpr double step = 10e-6;
    for (int k = 0; k <= static_cast<int>(std::lround(until / step)); ++k) {
      set_velocity(direction * (30 + speed(k * step)));
      gauges[axis] += k > 0 ? direction * 1e-9 : 0; // inwards, all but at rest
      record_.step(scene_, k * step, gauges);
    }
  }
  const SceneSpec& spec() const { return read_.scene; }
  const InjuryRecord<Dim>& record() const { return record_; }
  std::vector<InjuryValue> values() const { return injury_values(spec(), record_, {{1.0}, {0}}); }
  InjuryValue value(InjuryMeasure measure) const {
    const std::vector<InjuryValue> all = values();
    return *std::find_if(all.begin(), all.end(), [&](const InjuryValue& v) { return v.measure == measure; });
  }
  std::vector<std::string> warnings() const { return injury_warnings(spec(), record_, values()); }

private:
  /// Gained since the beginning, m/s.
  static double speed(double t) {
    const double s = std::min(std::max(t - begin, 0.0), length), w = 2 * std::numbers::pi / length;
    return height * (0.5 * s - 0.5 * std::sin(w * s) / w);
  }
  void set_velocity(double u) {
    Block<Dim>& b = scene_.blocks[0];
    for (int k = 0; k <= (Dim == 3 ? b.grid.cells[2] : 0); ++k) {
      for (int j = 0; j <= b.grid.cells[1]; ++j) {
        std::fill_n(b.velocity[Dim - 1].row(b.grid.node_row(j, k)), b.grid.cells[0] + 1, u);
      }
    }
  }

  io::TemporaryFolder folder_;
  ReadScene read_;
  Scene<Dim> scene_;
  InjuryRecord<Dim> record_;
};

} // namespace ballast::injury_scenes
