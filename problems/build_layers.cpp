#include "problems/build_layers.hpp"

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
  LayerStack<Dim> stack = make_stack<Dim>(in);
  stack.rate_time = spec.rate_time;
  return stack;
}

template <int Dim> std::vector<LayerStack<Dim>> build_stacks(const SceneSpec& scene) {
  std::vector<LayerStack<Dim>> stacks;
  for (const LayersSpec& spec : scene.layers) {
    stacks.push_back(build_stack<Dim>(spec, scene.geometry));
  }
  return stacks;
}

template LayerStack<2> build_stack<2>(const LayersSpec&, Geometry);
template LayerStack<3> build_stack<3>(const LayersSpec&, Geometry);
template std::vector<LayerStack<2>> build_stacks<2>(const SceneSpec&);
template std::vector<LayerStack<3>> build_stacks<3>(const SceneSpec&);

} // namespace ballast
