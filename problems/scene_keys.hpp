// The deck language: every section and key, in one table that parses, checks and documents them.
#pragma once

#include "core/deck_keys.hpp"

namespace ballast::scene_keys {

/// What a velocity (m/s) may be: more is a slip of the unit.
inline KeyRange speeds() {
  return {-1e6, 1e6};
}

const SectionSpec& top();
const SectionSpec& ambient();
const SectionSpec& body();
const SectionSpec& shape();
const SectionSpec& box(std::size_t dim);
const SectionSpec& sphere(std::size_t dim);
const SectionSpec& cylinder(std::size_t dim);
const SectionSpec& revolved(std::size_t dim);
const SectionSpec& half_space(std::size_t dim);
const SectionSpec& stl();
const SectionSpec& voxels();
const SectionSpec& rotate(std::size_t dim);
const SectionSpec& mesh();
const SectionSpec& mesh_outline();
const SectionSpec& mesh_axis(Dimension dimension = Dimension::length);
const SectionSpec& velocity_radial(std::size_t dim);
const SectionSpec& boundary();
const SectionSpec& motion();
const SectionSpec& material();
const SectionSpec& layers();
const SectionSpec& fabric();
const SectionSpec& yarns();
const SectionSpec& transverse();
const SectionSpec& shear();
const SectionSpec& solid();
const SectionSpec& rate();
const SectionSpec& numerics();
const SectionSpec& gauge();
const SectionSpec& output();
const SectionSpec& results();
const SectionSpec& injury();

/// docs/deck.md, whole.
std::string reference();

} // namespace ballast::scene_keys
