#include "problems/build_layers.hpp"

#include <algorithm>

namespace ballast {

template <int Dim> LayerStack<Dim> build_stack(const LayersSpec& spec, Geometry geometry) {
  LayerInput in;
  in.name = spec.name;
  in.model = spec.model;
  in.lines = spec.lines;
  in.layers = spec.layers;
  in.through = spec.through;
  in.levels = even_lines(spec.low(), spec.high(), spec.layers * spec.through);
  in.axisymmetric = geometry == Geometry::axisymmetric;
  in.edge = spec.edge;
  in.edge_stiffness = spec.edge_stiffness;
  in.hourglass = spec.hourglass;
  in.guard = spec.guard;
  in.viscosity = spec.viscosity;
  LayerStack<Dim> stack = make_stack<Dim>(in);
  stack.rate_time = spec.rate_time;
  return stack;
}

template <int Dim> Layers<Dim> build_layers(const LayersSpec& spec, Geometry geometry) {
  Layers<Dim> layers;
  layers.stack = build_stack<Dim>(spec, geometry);
  layers.contact.friction = spec.friction;
  layers.cfl = spec.cfl;
  layers.substeps = std::max(1, spec.subcycles);
  return layers;
}

template LayerStack<2> build_stack<2>(const LayersSpec&, Geometry);
template LayerStack<3> build_stack<3>(const LayersSpec&, Geometry);
template Layers<2> build_layers<2>(const LayersSpec&, Geometry);
template Layers<3> build_layers<3>(const LayersSpec&, Geometry);

} // namespace ballast
