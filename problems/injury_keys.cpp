// Keys of the injury measures.
#include "problems/scene_keys.hpp"

namespace ballast::scene_keys {

using enum KeyKind;

const SectionSpec& injury() {
  static const SectionSpec spec = {
      "[injury]",
      "Injury measures in summary.json and printed at the end (docs/injury.md: formulas, thresholds, limits). **Research output, not medical advice.** Only what is asked for is measured; without this table nothing is, at no cost. Gauges named here ride with the material.",
      {{.name = "direction", .kind = text, .doc = "`+z` and the like: along it deflections, velocities and forces count; default the way of the bullet of [results], without one the last axis upwards"},
       {.name = "sternum", .kind = text, .doc = "a gauge: deflection and velocity; with `chest_depth` compression and viscous criterion"},
       {.name = "spine", .kind = text, .doc = "a gauge whose way is taken from the sternum's; default: the spine rests"},
       {.name = "chest_depth", .kind = quantity, .doc = "D0, from sternum to spine", .dimension = Dimension::length, .range = positive()},
       {.name = "back_face", .kind = text, .doc = "a stack of [[layers]], the largest deflection of any node of its back face, or a gauge: back-face signature against 44 mm"},
       {.name = "accelerometers", .kind = texts, .doc = "gauges whose peak acceleration along the shot is reported, both ways; default the sternum's"},
       {.name = "filters",
        .kind = choices,
        .doc = "channel frequency classes of SAE J211-1 for accelerations and the impact force",
        .fallback = "CFC1000",
        .choices = {"CFC60", "CFC180", "CFC600", "CFC1000"}},
       {.name = "record_every", .kind = quantity, .doc = "interval of the record that is filtered, to which the steps are interpolated; at most a tenth of 1 / CFC, with `blast_gauges` 50 us", .dimension = Dimension::time, .range = positive(), .fallback = "1 us"},
       {.name = "sample_every", .kind = quantity, .doc = "accelerations are reported once more as points so far apart, as a recorder takes them (20 us: 50 kHz); a multiple of `record_every`", .dimension = Dimension::time, .range = positive(), .fallback = "20 us"},
       {.name = "organs", .kind = texts, .doc = "materials whose peak pressure is reported, with time and place"},
       {.name = "force_on", .kind = texts, .doc = "materials that together are the body: the rate of their momentum along the shot is the impact force; not planar"},
       {.name = "blast_gauges", .kind = texts, .doc = "gauges whose pressure over the ambient one loads a chest wall in blast: its velocity, mean over them (four around a rigid cylinder in the original), and ASII"},
       {.name = "impactor", .kind = texts, .doc = "bodies whose energy at the start and diameter go into blunt criterion, four-parameter lethality and energy over area; all that is of their materials, at one velocity for each; not planar"},
       {.name = "impactor_energy", .kind = quantity, .doc = "instead of that of the bodies: of what hits the body, behind a vest not the bullet's", .dimension = Dimension::energy, .range = positive()},
       {.name = "impactor_diameter", .kind = quantity, .doc = "likewise", .dimension = Dimension::length, .range = positive()},
       {.name = "body_mass", .kind = quantity, .doc = "of the person; without it energy over area only", .dimension = Dimension::mass, .range = positive()},
       {.name = "wall_thickness", .kind = quantity, .doc = "of the body wall; default 0.711 W^(1/3) cm of a man of W kg", .dimension = Dimension::length, .range = positive()}}};
  return spec;
}

} // namespace ballast::scene_keys
