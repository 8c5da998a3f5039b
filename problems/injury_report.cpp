#include "problems/injury_report.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace ballast {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const InjuryValue& v) {
  const InjuryCriterion& c = criterion(v.measure);
  ordered_json j = {{"measure", c.name}, {"value", v.value}, {"unit", c.unit}};
  if (v.time > 0) {
    j["at_s"] = v.time;
  }
  if (v.at_least) {
    j["at_least"] = true;
  }
  j["formula"] = c.formula;
  j["thresholds"] = ordered_json::array();
  for (const InjuryThreshold& t : c.thresholds) {
    j["thresholds"].push_back({{"value", t.value}, {"meaning", t.meaning}, {"confidence", t.mark}, {"value_over_threshold", v.value / t.value}});
  }
  j["source"] = c.source;
  j["confidence"] = c.mark;
  j["limits"] = c.limits;
  return j;
}

ordered_json json_of(const BothWays& peaks) {
  return {{"along", peaks.along.value}, {"along_at_s", peaks.along.time}, {"against", peaks.against.value}, {"against_at_s", peaks.against.time}};
}

ordered_json json_of(const OrganPeak& organ, double ambient) {
  ordered_json j = {{"value_Pa", nullptr}, {"over_ambient_Pa", nullptr}, {"at_s", organ.time}, {"at_m", organ.peak.at}, {"limits", criterion(InjuryMeasure::peak_pressure).limits}};
  if (std::isfinite(organ.peak.pressure)) { // else no cell was ever half full of it
    j["value_Pa"] = organ.peak.pressure;
    j["over_ambient_Pa"] = organ.peak.pressure - ambient;
  }
  return j;
}

} // namespace

template <int Dim> ordered_json injury_results(const SceneSpec& scene, const InjuryRecord<Dim>& record, const StartOfRun& start) {
  if (!record.asked()) {
    return nullptr;
  }
  const InjurySpec& in = *scene.injury;
  ordered_json j;
  j["note"] = injury_note;
  j["criteria"] = ordered_json::object();
  const std::vector<InjuryValue> values = injury_values(scene, record, start);
  for (const InjuryValue& v : values) {
    j["criteria"][criterion(v.measure).key] = json_of(v);
  }
  for (const InjurySite& site : record.sites()) {
    if (std::find(in.accelerometers.begin(), in.accelerometers.end(), site.gauge) == in.accelerometers.end()) {
      continue;
    }
    ordered_json& gauge = j["peak_acceleration_m_per_s2"][scene.gauges[static_cast<std::size_t>(site.gauge)].name];
    gauge = {{"recorded_every_s", in.record_every}, {"sampled_every_s", in.sample_every}};
    for (const auto& [name, peaks] : peak_accelerations(scene, record, site)) {
      gauge[name] = json_of(peaks);
    }
  }
  for (const OrganPeak& organ : record.organs()) {
    j["peak_pressure"][scene.materials[static_cast<std::size_t>(organ.material)].name] = json_of(organ, scene.ambient_pressure);
  }
  for (const auto& [name, peaks] : peak_forces(scene, record)) {
    j["force_N"][name] = json_of(peaks);
  }
  j["warnings"] = injury_warnings(scene, record, values);
  return j;
}

std::string injury_lines(const ordered_json& results) {
  if (results.is_null()) {
    return "";
  }
  std::string text = "injury measures\n";
  const auto line = [&](const std::string& name, double value, const std::string& rest) { text += fmt::format("  {:<42} {:>12.5g} {}\n", name, value, rest); };
  const auto part = [&](const char* key) { return results.value(key, ordered_json::object()); };
  const ordered_json criteria = part("criteria"), accelerations = part("peak_acceleration_m_per_s2"), pressures = part("peak_pressure");
  for (const ordered_json& c : criteria) {
    std::string rest = c["unit"] == "1" ? "" : c["unit"].get<std::string>();
    for (const ordered_json& t : c["thresholds"]) {
      rest += fmt::format("; {:.3g} of {:g}: {} [{}]", t["value_over_threshold"].get<double>(), t["value"].get<double>(), t["meaning"].get<std::string>(), t["confidence"].get<std::string>());
    }
    line(c["measure"].get<std::string>(), c["value"].get<double>(), rest);
  }
  for (const auto& [gauge, by_name] : accelerations.items()) {
    for (const auto& [name, both] : by_name.items()) {
      if (both.is_object()) {
        line(fmt::format("peak acceleration {}, {}", gauge, name), both["along"].template get<double>(), fmt::format("m/s2, against the shot {:.5g}", both["against"].template get<double>()));
      }
    }
  }
  for (const auto& [organ, p] : pressures.items()) {
    if (p["value_Pa"].is_number()) {
      line(fmt::format("peak pressure {}", organ), p["value_Pa"].template get<double>(), fmt::format("Pa at {:.4g} s", p["at_s"].template get<double>()));
    }
  }
  for (const ordered_json& warning : results["warnings"]) {
    text += fmt::format("  note: {}\n", warning.get<std::string>());
  }
  return fmt::format("{}{}\n", text, results["note"].get<std::string>());
}

template ordered_json injury_results<2>(const SceneSpec&, const InjuryRecord<2>&, const StartOfRun&);
template ordered_json injury_results<3>(const SceneSpec&, const InjuryRecord<3>&, const StartOfRun&);

} // namespace ballast
