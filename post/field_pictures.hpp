// Pictures of the fields: for up to six times one picture with the materials, the pressure and the
// speed, all on the same view and scale. When the action fills a small part of the view, a close-up
// of it is drawn too.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "post/field_scale.hpp"
#include "post/section.hpp"

namespace ballast::post {

/// Writes fields_NN.png (and closeup_NN.png) for the sections into `folder`; one line to `log` for
/// each. Returns the number of pictures. `close`: what the close-ups show, instead of what moves.
int draw_field_pictures(const std::vector<Section>& sections,
                        const std::string& title,
                        const std::filesystem::path& folder,
                        std::ostream& log,
                        const std::optional<View>& close = std::nullopt);

} // namespace ballast::post
