#include "problems/layers_report.hpp"

#include "ale/layers/layer_step.hpp"
#include "problems/build_layers.hpp"

#include <fmt/format.h>

namespace ballast {
namespace {

template <int Dim> double bytes_of(const LayerStack<Dim>& s) {
  const auto nodes = static_cast<double>(s.node_count()), elements = static_cast<double>(s.element_count());
  const double of_node = 8 * (5 * Dim + 1), rates = s.rate[0][0].empty() ? 0 : 4;
  const double of_element = 8 * (LayerStack<Dim>::strains + LayerStack<Dim>::hourglass_modes + 6 + rates + 3) + 1;
  return nodes * of_node + elements * of_element;
}

/// Of one layer, which all others are like: sizes by count, the step as it is.
template <int Dim> LayersCost cost_of(const LayersSpec& layers, const SceneSpec& scene) {
  LayersSpec one = layers;
  one.layers = 1;
  one.thickness = layers.thickness / layers.layers;
  one.edge_stiffness = layers.edge_stiffness / layers.layers;
  LayerStack<Dim> stack = build_stack<Dim>(one, scene.geometry);
  LayerLedger ledger;
  ThreadPool pool(1);
  update_forces(stack, 0, ledger, pool);
  LayersCost cost;
  const double count = layers.layers;
  cost.elements = count * static_cast<double>(stack.element_count());
  cost.nodes = count * static_cast<double>(stack.node_count());
  cost.mass = count * totals(stack).mass;
  cost.bytes = count * bytes_of(stack);
  cost.step = stable_step(stack, layers.cfl).dt;
  cost.steps = scene.end_time / cost.step;
  const double microseconds = Dim == 3 ? 0.25 : 0.07; // an element-step of the printed law, measured
  cost.core_seconds = 1e-6 * microseconds * cost.elements * cost.steps;
  return cost;
}

} // namespace

LayersCost layers_cost(const LayersSpec& layers, const SceneSpec& scene) {
  return scene.geometry == Geometry::three_d ? cost_of<3>(layers, scene) : cost_of<2>(layers, scene);
}

std::string layers_table(const SceneSpec& scene) {
  const bool planar = scene.geometry == Geometry::planar;
  const std::string axis = axis_names(scene.geometry).back();
  std::string out = scene.layers.empty() ? "" : "layers\n";
  for (const LayersSpec& l : scene.layers) {
    const LayersCost cost = layers_cost(l, scene);
    out += fmt::format("  {:<16} {} layer{} of {:.4g} plies, {} element{} through, {} elements in the plane; {:.0f} elements, {:.0f} nodes\n", l.name, l.layers, l.layers == 1 ? "" : "s",
                       static_cast<double>(l.plies) / l.layers, l.through, l.through == 1 ? "" : "s", fmt::format("{:.0f}", cost.elements / (l.layers * l.through)), cost.elements, cost.nodes);
    out += fmt::format("  {:<16} {} {:.4g} to {:.4g} mm, half width {:.4g} mm; {:.5g} kg/m2, {:.4g} kg/m3, {:.6g} {}\n", "", axis, l.low() * 1e3, l.high() * 1e3, l.lines[0].back() * 1e3, l.areal_density(),
                       l.density(), cost.mass * (planar ? 1 : 1e3), planar ? "kg/m" : "g");
    out += fmt::format("  {:<16} {}: {}\n", "", l.fabric, describe(l.model));
    const std::string subcycles = l.subcycles > 0 ? fmt::format("{} steps to one of the mesh", l.subcycles) : std::string("as many steps to one of the mesh as it asks");
    out += fmt::format("  {:<16} friction {:g}, {}; stable step {:.3g} us, {:.0f} steps to the end, {:.3g} MB, about {:.2g} s on one core\n", "", l.friction, subcycles, cost.step * 1e6, cost.steps,
                       cost.bytes * 1e-6, cost.core_seconds);
  }
  return out;
}

} // namespace ballast
