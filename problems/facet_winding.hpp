// How often a surface of facets winds around the points of a line: 1 in the solid, 0 outside of it. Twice, where two solids share
// a place; less than nothing, where a cavity lies in no solid. Filled by counting crossings such places would come out empty or
// full, whichever the surfaces' own volumes say.
#pragma once

#include "problems/facet_mesh.hpp"

#include <string>

namespace ballast {

/// Where the facets enclose a place twice or inside out; empty: nowhere. `mesh` has passed surface_flaw(), so that each surface of it
/// is closed.
///
/// Winding numbers along lines through every facet near its three corners and in its middle, and through points spread over the
/// box around all (of more than 20 000 facets as many, spread evenly). Solids that only touch have a length of nothing in common.
std::string shared_space(const FacetMesh& mesh);

} // namespace ballast
