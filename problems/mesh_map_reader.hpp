// Parts of the mesh reader that know curvilinear meshes. Private to problems/.
#pragma once

#include "core/deck_keys.hpp"
#include "problems/scene_spec.hpp"

namespace ballast {

/// `map`, `outer_radius`, `centre` and `outline` of [mesh]; scene.geometry and motion must be known. False: no such map, its axes mean nothing.
bool read_map(Deck& deck, DeckNode& mesh, SceneSpec& scene);

/// A field that the deck left to its default, empty as yet.
DeckNode& add_default(DeckNode& table, const std::string& key, DeckNode::Kind kind);

/// `outline` of a `turned` mesh, placed along z. False and an error: there is none, or it does not fit a mesh.
bool read_outline(Deck& deck, DeckNode& mesh, SceneSpec& scene);

/// Gives the table of z of a `turned` mesh the outline's ends where it has no `from` or `to`.
void add_outline_ends(DeckNode& axis_table, const SceneSpec& scene, int axis);

/// False (and an error) where the lines of an axis reach to where its map has no cells.
bool check_mapped_axis(Deck& deck, DeckNode& axis_table, const SceneSpec& scene, int axis);

/// A side of a mapped mesh whose lines are known.
struct MappedSide {
  int normal = -1;            ///< velocity component, -1: curved or slanted
  bool cuts_the_body = false; ///< a plane through the centre: symmetric unless the deck says otherwise
  bool axis = false;          ///< r = 0
};
MappedSide mapped_side(const SceneSpec& scene, int axis, int side);

/// May this side of a mapped mesh be of this kind? If not, an error at `type`.
bool check_mapped_side(Deck& deck, DeckNode& type, const SceneSpec& scene, int axis, int side, BoundaryKind kind);

} // namespace ballast
