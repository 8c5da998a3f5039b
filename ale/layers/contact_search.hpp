// Looks for the feet of nodes that have none: all segments in buckets, each node among those around it.
#pragma once

#include "ale/layers/contact_track.hpp"

namespace ballast {

/// Gives nodes with status `lost` (and `away`, if `all`) the nearest foot on a segment that is there and not further than half
/// that segment's diagonal; those without become `away`, or `beside` the nearest segment.
/// Deterministic: buckets in order, the first of equals.
template <int Dim> void search_feet(const TrackPair<Dim>& pair, bool all, ContactTrack<Dim>& track);

/// How far the surfaces may move towards each other before nodes that are away must be looked for again, m.
template <int Dim> double search_again_after(const ContactSurface<Dim>& other);

} // namespace ballast
