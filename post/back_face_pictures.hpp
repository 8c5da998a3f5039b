// Back faces of fabric layers: deflection over the radius, a line for each time, from the back_face_*.csv beside the dumps.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/io/vtk.hpp"

namespace ballast::post {

/// A picture for each stack and axis that a run has profiles of: back_face_deflection_r.png, of several stacks
/// back_face_NAME_deflection_r.png. `times`: the dumps to show. Returns the number of pictures.
int draw_back_face_pictures(const std::filesystem::path& dir,
                            const std::vector<io::PvdEntry>& times,
                            const std::string& title,
                            const std::filesystem::path& folder,
                            std::ostream& log);

} // namespace ballast::post
