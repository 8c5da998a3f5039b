// `ballast report DIR`: pictures of a finished (or running) run, in DIR/pictures.
#pragma once

#include <iosfwd>
#include <string>

namespace ballast::post {

/// Reads DIR/fields.pvd and DIR/history.csv (either may be missing) and writes PNGs; names them on
/// `log`. Needs no X server. Returns the number of pictures; throws Error if there is nothing to
/// draw or a file is damaged. `view`: "from, to, from, to" of the close-ups' two axes, lengths with units; empty: what moves.
int report(const std::string& run_dir, std::ostream& log, const std::string& view = {});

} // namespace ballast::post
