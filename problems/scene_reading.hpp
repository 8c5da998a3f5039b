// Parts of the scene reader that know one kind of thing each. Private to problems/.
#pragma once

#include "core/deck_keys.hpp"
#include "problems/scene_spec.hpp"
#include "problems/shape_placement.hpp"

#include <map>
#include <optional>

namespace ballast {

/// Named materials with the deck's overrides; hands out indices in order of first use.
class MaterialBook {
public:
  /// Reads [materials]; `table` may be null.
  MaterialBook(Deck& deck, DeckNode* table, double ambient_pressure, double ambient_temperature);
  /// Index of a material, -1 for void; nothing (and an error at `blame`) for an unknown one.
  std::optional<int> index(Deck& deck, const std::string& name, DeckNode& blame);
  const std::vector<Material>& used() const { return used_; }

private:
  void define(Deck& deck, const std::string& name, DeckNode& node);
  double pressure_, temperature_;
  std::map<std::string, Material> defined_;
  std::vector<std::string> broken_; ///< defined with errors: no second error where they are used
  std::vector<Material> used_;
};

/// Energy (J/kg) and pressure (Pa) of a material at `density` in a section that may give a `pressure`: without one at
/// the ambient pressure, unless the material brings its own energy (JWL) or has no choice (linear bulk).
struct StartState {
  double specific_energy = 0, pressure = 0;
};
StartState start_state(Deck& deck, const Section& in, const Material& m, double density, double ambient);

/// A `shape` table; nothing (and errors) if it is not one.
std::optional<Shape> read_shape(Deck& deck, DeckNode& node, Geometry geometry);

/// Points [z, r] of an outline, m.
using Profile = std::vector<std::array<double, 2>>;

/// `file` or `profile` of an outline; what crosses itself is refused with the place.
std::optional<Profile> read_profile(Deck& deck, const Section& in);

/// An `stl` table: a closed surface from a file; nothing (and an error) if it encloses no solid.
std::optional<Shape> read_surface(Deck& deck, DeckNode& node, Geometry geometry);

/// A `voxels` table: labels of an image; nothing (and an error) if they cannot be had.
std::optional<Shape> read_voxels(Deck& deck, DeckNode& node, Geometry geometry);

/// `units` of a file: metres in one of them; nothing (and an error) for a word that is no unit of length.
std::optional<double> read_units(Deck& deck, const Section& in);
/// The resolved deck says which `file` it was, wherever it is read from, by its place and `checksum`.
void pin_file(Deck& deck, const Section& in, const std::string& path, const std::string& checksum);

/// `rotate` and `offset` of a shape's table applied to it.
std::optional<Shape> read_placed(Deck& deck, const Section& in, Geometry geometry, const Shape& shape);

/// Shapes of the library part `name` ("bullet/m80"), tip at the origin, nose along +axis.
struct PartBody {
  std::string name, material;
  std::vector<std::array<double, 2>> outline; ///< z (0 at the base), r
  std::vector<std::array<double, 2>> hollow;  ///< taken out of it, may be empty
};
struct Part {
  double length; ///< base to tip, m
  std::vector<PartBody> bodies; ///< the last has the outside
};
const Part* find_part(std::string_view name);

/// Unit vector of "+x" ... "-z" in mesh axes; nothing (and an error at `blame`) if the geometry
/// lacks it.
std::optional<Point>
read_direction(Deck& deck, const std::string& text, Geometry geometry, DeckNode& blame);

/// "+z", planar "+x".
std::string default_direction(Geometry geometry);

/// How a bullet leans: `flight` turns its velocity, `body` its shape; `aim` is the direction of
/// an oblique shot before either, or nothing.
struct Attitude {
  Point aim{};
  Rotation flight = Placement{}.turn;
  Placement body;
};
/// `yaw`, `obliquity`, `hit_offset` and `towards` of a body shot along `direction`, turned about
/// `tip`; nothing (and an error) where the scene cannot hold a bullet that leans.
std::optional<Attitude>
read_attitude(Deck& deck, const Section& in, const SceneSpec& scene, const Point& direction, const Point& tip);

/// Numbers of a list as a point; absent coordinates 0.
Point point_of(const std::vector<double>& values);

/// All [[body]] entries.
void read_bodies(Deck& deck, DeckNode* list, MaterialBook& book, SceneSpec& scene);

/// Has an error kept a body of the deck out of the scene? Other sections that name its material are then not wrong for that.
bool bodies_missing(const Deck& deck, const SceneSpec& scene);

/// Bodies by name, as indices; unknown names are reported, but for bodies whose own errors kept them out.
std::vector<int> listed_bodies(Deck& deck, DeckNode& list, const SceneSpec& scene);

/// A list of materials in use, each once, as indices into them; `list` may be null.
std::vector<int> listed_materials(Deck& deck, DeckNode* list, const SceneSpec& scene);

/// [injury], after gauges, results and layers, which it names.
void read_injury(Deck& deck, DeckNode& node, SceneSpec& scene);

/// [motion], but for what a following mesh goes with.
void read_motion(Deck& deck, DeckNode& node, Motion& motion);

/// What a following mesh goes with, once there are bodies; its outer sides along that way must let matter through.
void read_follow(Deck& deck, DeckNode& node, SceneSpec& scene);

/// All [[layers]], after bodies and results: they lie behind their front as the shot goes. `fabrics`: [fabrics], or null.
void read_layers(Deck& deck, DeckNode* list, DeckNode* fabrics, MaterialBook& materials, SceneSpec& scene);

/// [mesh] with lines and boundaries.
void read_mesh(Deck& deck,
               DeckNode& mesh,
               const std::vector<std::string>& symmetry,
               MaterialBook& book,
               SceneSpec& scene);

} // namespace ballast
