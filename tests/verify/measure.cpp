#include "tests/verify/measure.hpp"

#include "core/error.hpp"
#include "tests/verify/trial.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace ballast::verify {

const char* short_name(MotionPolicy motion) {
  static const char* const names[] = {"Lag", "Eul", "follow", "relax"};
  return names[static_cast<int>(motion)];
}

template <int Dim> void conserves(VerifyReport& r, const std::string& name, const TubeRun<Dim>& run) {
  const Conservation c = conservation(run);
  const double worst = c.worst();
  r.at_most(name + ", conservation", 1e-12, worst);
  if (!(worst <= 1e-12)) {
    r.note(name + ", energy", c.energy);
    r.note(name + ", mass", c.mass);
    r.note(name + ", momentum", c.momentum);
    r.note(name + ", kinetic energy not returned", c.unreturned);
    r.note(name + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
  }
}

template <int Dim> void untouched(VerifyReport& r, const std::string& name, const TubeRun<Dim>& run) {
  const Ledger& l = run.scene.ledger;
  r.at_most(name + ", floors, slivers, retries", 0, static_cast<double>(l.energy_floors + l.slivers + l.retries));
  if (l.energy_floors + l.slivers + l.retries > 0) {
    r.note(name + ", floors", static_cast<double>(l.energy_floors));
    r.note(name + ", slivers", static_cast<double>(l.slivers));
    r.note(name + ", retries", static_cast<double>(l.retries));
  }
}

namespace {

/// Crossing of `level` between cells a and b, or NaN.
double crossing(const TubeCell& a, const TubeCell& b, const CellValue& value, double level) {
  const double va = value(a) - level, vb = value(b) - level;
  return va * vb <= 0 && va != vb ? a.centre + (b.centre - a.centre) * va / (va - vb)
                                  : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

double rightmost_crossing(const std::vector<TubeCell>& cells, const CellValue& value, double level) {
  for (std::size_t i = cells.size() - 1; i > 0; --i) {
    if (const double x = crossing(cells[i - 1], cells[i], value, level); !std::isnan(x)) {
      return x;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double leftmost_crossing(const std::vector<TubeCell>& cells, const CellValue& value, double level) {
  for (std::size_t i = 1; i < cells.size(); ++i) {
    if (const double x = crossing(cells[i - 1], cells[i], value, level); !std::isnan(x)) {
      return x;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double mean_between(const std::vector<TubeCell>& cells, const CellValue& value, double from, double to) {
  double sum = 0, width = 0;
  for (const TubeCell& c : cells) {
    if (!c.mixed && c.centre >= from && c.centre <= to) {
      sum += value(c) * c.width;
      width += c.width;
    }
  }
  return sum / width;
}

bool Arrival::record(const Scene<2>& scene, const Clock& clock) {
  if (!std::isnan(arrival_)) {
    return true;
  }
  const double now = rightmost_crossing(profile(scene.blocks[0], 0), value_, level_);
  if (before_ < station_ && now >= station_) {
    arrival_ = time_before_ + (clock.time - time_before_) * (station_ - before_) / (now - before_);
  }
  before_ = now;
  time_before_ = clock.time;
  return true;
}

TubeRun<2> run_watched(const Tube& tube, const std::vector<Observer<2>*>& observers) {
  TubeRun<2> r = make_tube<2>(tube);
  go(r.scene, r.clock, observers);
  r.end = totals(r.scene.blocks[0]);
  return r;
}

template <int Dim>
TubeRun<Dim> run_scene(Scene<Dim>&& scene, double end_time, const std::vector<Observer<Dim>*>& observers) {
  TubeRun<Dim> r;
  r.scene = std::move(scene);
  r.clock.end_time = end_time;
  prepare(r.scene);
  r.start = totals(r.scene.blocks[0]);
  go(r.scene, r.clock, observers);
  r.end = totals(r.scene.blocks[0]);
  return r;
}

template <int Dim> std::string try_scene(Scene<Dim>&& scene, double end_time, TubeRun<Dim>& run) {
  std::string why;
  run.scene = std::move(scene);
  run.clock = {};
  run.clock.end_time = end_time;
  prepare(run.scene);
  run.start = totals(run.scene.blocks[0]);
  try {
    go(run.scene, run.clock);
  } catch (const NumericalFailure& failure) {
    why = failure.what();
  }
  run.end = totals(run.scene.blocks[0]);
  return why;
}

template <int Dim> bool ends(VerifyReport& r, const std::string& name, Scene<Dim>&& scene, double end_time, TubeRun<Dim>& run) {
  const std::string why = try_scene(std::move(scene), end_time, run);
  r.close(name + ", end time" + (why.empty() ? "" : fmt::format(" ({})", why)), end_time, 1e-12, run.clock.time);
  return why.empty();
}

template void conserves<2>(VerifyReport&, const std::string&, const TubeRun<2>&);
template void conserves<3>(VerifyReport&, const std::string&, const TubeRun<3>&);
template void untouched<2>(VerifyReport&, const std::string&, const TubeRun<2>&);
template void untouched<3>(VerifyReport&, const std::string&, const TubeRun<3>&);
template TubeRun<2> run_scene<2>(Scene<2>&&, double, const std::vector<Observer<2>*>&);
template TubeRun<3> run_scene<3>(Scene<3>&&, double, const std::vector<Observer<3>*>&);
template std::string try_scene<2>(Scene<2>&&, double, TubeRun<2>&);
template std::string try_scene<3>(Scene<3>&&, double, TubeRun<3>&);
template bool ends<2>(VerifyReport&, const std::string&, Scene<2>&&, double, TubeRun<2>&);
template bool ends<3>(VerifyReport&, const std::string&, Scene<3>&&, double, TubeRun<3>&);

} // namespace ballast::verify
