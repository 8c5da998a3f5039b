// Plots of history.csv: one picture for each group of columns that share a unit, at most eight
// lines each.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "core/io/history.hpp"

namespace ballast::post {

/// Writes history_QUANTITY.png into `folder`; one line to `log` for each. Returns the number of
/// pictures.
int draw_history_pictures(const io::Table& history,
                          const std::string& title,
                          const std::filesystem::path& folder,
                          std::ostream& log);

} // namespace ballast::post
