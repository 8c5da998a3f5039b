// Injury measures of a run in summary.json under `injury`, and in printed lines.
#pragma once

#include "problems/injury_values.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ballast {

/// Null where the deck does not ask.
template <int Dim> nlohmann::ordered_json injury_results(const SceneSpec& scene, const InjuryRecord<Dim>& record, const StartOfRun& start);

/// The same for a reader; empty where the deck does not ask.
std::string injury_lines(const nlohmann::ordered_json& results);

} // namespace ballast
