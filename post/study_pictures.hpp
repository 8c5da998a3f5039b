// Pictures of a study: error against cost with the Pareto front, error and cost against what was varied.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace ballast::post {

/// Does the folder hold a study (and not a run of one)?
bool is_study(const std::filesystem::path& folder);

/// Reads study.json in `folder`, draws into folder/pictures, names every picture in `log`. Returns their number. Throws Error.
int draw_study(const std::filesystem::path& folder, std::ostream& log);

} // namespace ballast::post
