// Pictures of the fields: for up to six times one picture with the materials, the pressure and the
// speed, all on the same view and scale. When the action fills a small part of the view, a close-up
// of it is drawn too.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "post/section.hpp"

namespace ballast::post {

/// Writes fields_NN.png (and closeup_NN.png) for the sections into `folder`; one line to `log` for
/// each. Returns the number of pictures.
int draw_field_pictures(const std::vector<Section>& sections,
                        const std::string& title,
                        const std::filesystem::path& folder,
                        std::ostream& log);

} // namespace ballast::post
