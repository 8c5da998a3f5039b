// What makes injury measures weaker than they look.
#include "core/cfc_filter.hpp"
#include "problems/injury_values.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double fewest_spans = 4; // of 1 / CFC in a record

/// Peaks that the end of the record may have cut. One at the start may not: before it the scene flies freely, and nothing is there.
class EndOfRecord {
public:
  EndOfRecord(double time, std::vector<std::string>& warnings) : time_(time), warnings_(warnings) {}

  /// `within` the last so many seconds. A peak of no time (0) has never risen.
  void check(const std::string& name, double peak_time, double within) {
    if (peak_time > 0 && peak_time >= time_ - within) {
      warnings_.push_back(fmt::format("{} is largest at {:g} s, at the end of the record ({:g} s): it may go on growing, the run is too short for it", name, peak_time, time_));
    }
  }
  void check(const std::string& name, const BothWays& peaks, double within) {
    check(name, peaks.along.time, within);
    check(name + " against the shot", peaks.against.time, within);
  }

private:
  double time_;
  std::vector<std::string>& warnings_;
};

bool is_filtered(const InjurySpec& in) { return !in.accelerometers.empty() || !in.force_on.empty(); }

/// Is a record too short for a filter?
bool is_short(double time, double cfc) { return time * cfc < fewest_spans; }

/// How far from the end a peak has to lie, s, by the name that filters have in summary.json; below 0: a warning says it of all.
double margin_of(const InjurySpec& in, const std::string& filter, double time) {
  if (!filter.starts_with("CFC")) {
    return filter == "sampled" ? in.sample_every : in.record_every;
  }
  const double cfc = std::stod(filter.substr(3));
  return is_short(time, cfc) ? -1 : 1 / cfc;
}

/// Others go with these: compression with deflection, crash practice with VC, and forces are looked at by each filter.
bool has_own_end(InjuryMeasure measure) {
  using enum InjuryMeasure;
  return measure != chest_compression && measure != viscous_criterion_crash && measure != impact_force;
}

template <int Dim> void warn_of_filters(const InjurySpec& in, const InjuryRecord<Dim>& record, std::vector<std::string>& all) {
  const double longest = record.record().longest_step();
  for (const int cfc : in.filters) {
    if (longest > longest_interval(cfc)) {
      all.push_back(fmt::format("steps of up to {:g} s are too long for CFC {}: at most {:g} s", longest, cfc, longest_interval(cfc)));
    }
    if (is_short(record.time(), cfc)) {
      all.push_back(fmt::format("{:g} s of record are less than {:g} / CFC {}: its peaks depend on how the record goes on beyond its end", record.time(), fewest_spans, cfc));
    }
  }
}

template <int Dim>
void warn_of_ends(const SceneSpec& scene, const InjuryRecord<Dim>& record, const std::vector<InjuryValue>& values, std::vector<std::string>& all) {
  const InjurySpec& in = *scene.injury;
  EndOfRecord end(record.time(), all);
  for (const InjuryValue& v : values) {
    if (has_own_end(v.measure)) {
      end.check(criterion(v.measure).name, v.time, in.record_every);
    }
  }
  for (const InjurySite& site : record.sites()) {
    if (std::find(in.accelerometers.begin(), in.accelerometers.end(), site.gauge) != in.accelerometers.end()) {
      for (const auto& [name, peaks] : peak_accelerations(scene, record, site)) {
        end.check(fmt::format("peak acceleration {}, {}", scene.gauges[static_cast<std::size_t>(site.gauge)].name, name), peaks, margin_of(in, name, record.time()));
      }
    }
  }
  for (const auto& [name, peaks] : peak_forces(scene, record)) {
    end.check("impact force " + name, peaks, margin_of(in, name, record.time()));
  }
  for (const OrganPeak& organ : record.organs()) {
    end.check("peak pressure " + scene.materials[static_cast<std::size_t>(organ.material)].name, organ.time, in.record_every);
  }
}

} // namespace

template <int Dim>
std::vector<std::string> injury_warnings(const SceneSpec& scene, const InjuryRecord<Dim>& record, const std::vector<InjuryValue>& values) {
  const InjurySpec& in = *scene.injury;
  std::vector<std::string> all;
  if (is_filtered(in)) {
    warn_of_filters(in, record, all);
  }
  warn_of_ends(scene, record, values, all);
  for (const InjurySite& site : record.sites()) {
    if (site.lost >= 0) {
      all.push_back(fmt::format("gauge \"{}\" rides no more from {:g} s on: it has left the mesh, or its material has left its cell", scene.gauges[static_cast<std::size_t>(site.gauge)].name, site.lost));
    }
  }
  if (std::any_of(values.begin(), values.end(), [](const InjuryValue& v) { return v.at_least; })) {
    all.emplace_back("the lung is squeezed to a tenth before the blast has ended: chest wall velocity and ASII are lower bounds");
  }
  if (!in.impactor.empty() && in.impactor_energy == 0 && !scene.layers.empty()) {
    all.emplace_back("the impactor's energy and diameter are those of the bodies before the vest, not of what touches the body behind it");
  }
  return all;
}

template std::vector<std::string> injury_warnings<2>(const SceneSpec&, const InjuryRecord<2>&, const std::vector<InjuryValue>&);
template std::vector<std::string> injury_warnings<3>(const SceneSpec&, const InjuryRecord<3>&, const std::vector<InjuryValue>&);

} // namespace ballast
