// Profiles: one-dimensional runs (a mesh one or a few cells wide) are drawn as lines over the long
// axis, one line for each time, instead of maps.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "post/section.hpp"

namespace ballast::post {

/// True if one side of all that is shown is more than 20 times the other and none of it is fabric.
bool is_one_dimensional(const std::vector<Section>& sections);

/// Writes profile_pressure.png and profile_speed.png; one line to `log` for each. Returns their
/// number.
int draw_profile_pictures(const std::vector<Section>& sections,
                          const std::string& title,
                          const std::filesystem::path& folder,
                          std::ostream& log);

} // namespace ballast::post
