#include "problems/run_layers.hpp"

#include "ale/embedding.hpp"
#include "problems/layers_measure.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace ballast {

namespace {

constexpr std::size_t numbers_of_a_stack = 7; // and two for each material

/// Has every layer lost an element?
template <int Dim> bool torn_through(const LayerStack<Dim>& s) {
  for (int level = 0; level < s.grid.levels(); ++level) {
    bool whole = true;
    for (int j = 0; j < (Dim == 3 ? s.grid.elements[1] : 1); ++j) {
      for (int i = 0; i < s.grid.elements[0]; ++i) {
        whole = whole && s.alive[s.element(i, j, level)] != 0;
      }
    }
    if (whole) {
      return false;
    }
  }
  return true;
}

} // namespace

/// kg now above and below that were not there at the start.
template <int Dim> std::array<double, 2> LayersRecord<Dim>::passed(const Scene<Dim>& scene, const Seen& seen, const std::vector<std::array<double, 2>>& now) {
  std::array<double, 2> sum = {0, 0};
  for (std::size_t m = 0; m < now.size() && m < seen.sides_start.size(); ++m) {
    if (std::any_of(scene.layers.begin(), scene.layers.end(), [m](const Layers<Dim>& l) { return l.debris == static_cast<int>(m); })) {
      continue; // was a layer
    }
    sum[0] += std::max(0.0, now[m][1] - seen.sides_start[m][1]);
    sum[1] += std::max(0.0, now[m][0] - seen.sides_start[m][0]);
  }
  return sum;
}

template <int Dim> LayerSums sum_layers(const std::vector<Layers<Dim>>& layers) {
  LayerSums sums;
  for (const Layers<Dim>& l : layers) {
    const LayerTotals t = totals(l.stack);
    const LayerLedger& ledger = l.ledger;
    sums.seconds += l.seconds;
    sums.contact_seconds += l.contact_seconds;
    sums.mass += t.mass;
    sums.kinetic += t.leapfrog_kinetic;
    sums.internal += t.internal + t.hourglass + t.shock_heat;
    sums.lost += ledger.edge_work + ledger.edge_loss + ledger.contact_loss + ledger.step_change - ledger.load_work;
    sums.load_work += ledger.load_work;
    for (std::size_t d = 0; d < 3; ++d) {
      sums.momentum[d] += t.momentum[d];
      sums.edge_impulse[d] += ledger.edge_impulse[d];
    }
  }
  return sums;
}

template <int Dim> std::vector<std::string> LayersRecord<Dim>::columns(const Scene<Dim>& scene) const {
  std::vector<std::string> all;
  for (const Layers<Dim>& l : scene.layers) {
    const std::vector<std::string> some = layer_columns(l.stack);
    all.insert(all.end(), some.begin(), some.end());
    if (!scene.embedded.empty()) {
      all.push_back(fmt::format("{}_passed_up [kg]", column_name(l.stack.name)));
      all.push_back(fmt::format("{}_passed_down [kg]", column_name(l.stack.name)));
    }
  }
  return all;
}

template <int Dim> std::vector<double> LayersRecord<Dim>::add(const Scene<Dim>& scene) {
  std::vector<double> all;
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const Layers<Dim>& l = scene.layers[q];
    const std::vector<double> some = layer_values(l.stack, l.ledger, spec_.layers[q].direction);
    all.insert(all.end(), some.begin(), some.end());
    const LayerMeasure m = measure_layers(l.stack, spec_.layers[q].direction);
    seen_[q].largest = std::max(seen_[q].largest, m.largest);
    seen_[q].largest_internal = std::max(seen_[q].largest_internal, m.totals.internal);
    if (!scene.embedded.empty()) {
      const std::vector<std::array<double, 2>> sides = masses_by_side(scene, q);
      seen_[q].sides_start = seen_[q].sides_start.empty() ? sides : seen_[q].sides_start;
      const std::array<double, 2> mass = passed(scene, seen_[q], sides);
      all.insert(all.end(), mass.begin(), mass.end());
      seen_[q].leak_while_whole = torn_through(l.stack) ? seen_[q].leak_while_whole : std::max(seen_[q].leak_while_whole, mass[0] + mass[1]);
    }
  }
  return all;
}

template <int Dim> void LayersRecord<Dim>::step(const Scene<Dim>& scene) {
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const Layers<Dim>& l = scene.layers[q];
    const double dt = stable_step(l.stack, l.cfl).dt;
    Seen& seen = seen_[q];
    if (seen.first_step == 0) {
      seen.first_step = seen.least_step = dt;
      seen.mass_start = totals(l.stack).mass;
    }
    seen.least_step = std::min(seen.least_step, dt);
  }
}

template <int Dim> void LayersRecord<Dim>::write_back_faces(const Scene<Dim>& scene, const std::filesystem::path& dir, int index) const {
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const LayerStack<Dim>& stack = scene.layers[q].stack;
    write_back_face(stack, spec_.layers[q].direction, back_face_file(dir, stack.name, scene.layers.size(), index));
  }
}

template <int Dim> nlohmann::ordered_json LayersRecord<Dim>::results(const Scene<Dim>& scene) const {
  nlohmann::ordered_json all;
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const Layers<Dim>& l = scene.layers[q];
    const LayerLedger& ledger = l.ledger;
    const LayerMeasure m = measure_layers(l.stack, spec_.layers[q].direction);
    const Seen& seen = seen_[q];
    nlohmann::ordered_json j;
    j["mass_kg"] = {{"start", seen.mass_start}, {"end", m.totals.mass}, {"eroded", m.eroded_mass}, {"became_debris", seen.mass_start - m.totals.mass}};
    j["deflection_m"] = {{"last", m.centre}, {"last_anywhere", m.largest}, {"largest", std::max(seen.largest, m.largest)}};
    j["deflection_velocity_m_per_s"] = m.velocity;
    for (std::size_t axis = 0; axis < m.dome.size(); ++axis) {
      const std::string name = Dim == 2 ? (l.stack.axisymmetric ? "r" : "x") : std::string(1, "xy"[axis]);
      j["dome_radius_m"][name] = {{"at_1_mm", m.dome[axis]}, {"at_5_percent", m.dome_part[axis]}};
    }
    j["momentum_kg_m_per_s"] = {{"end", m.totals.momentum}, {"given_by_edges", ledger.edge_impulse}};
    j["energy_J"] = {{"kinetic", m.totals.kinetic},
                     {"kinetic_of_the_account", m.totals.leapfrog_kinetic},
                     {"internal", m.totals.internal},
                     {"hourglass", m.totals.hourglass},
                     {"hourglass_share", m.totals.hourglass_share()},
                     {"hourglass_share_of_largest_internal", m.totals.hourglass / std::max({seen.largest_internal, m.totals.internal, 1e-300})},
                     {"shock_heat", m.totals.shock_heat},
                     {"edges", ledger.edge_work + ledger.edge_loss},
                     {"contact_loss", ledger.contact_loss},
                     {"friction_loss", ledger.friction_loss},
                     {"step_change", ledger.step_change},
                     {"from_the_mesh_around", ledger.load_work},
                     {"eroded", ledger.eroded_energy}};
    if (!scene.embedded.empty()) {
      const std::array<double, 2> mass = passed(scene, seen, masses_by_side(scene, q));
      j["passed_kg"] = {{"up", mass[0]}, {"down", mass[1]}, {"largest_while_whole", seen.leak_while_whole}};
    }
    j["penetration_deepest_m"] = ledger.deepest;
    j["approach_in_a_step_largest_by_thickness"] = l.closing;
    j["eroded_elements"] = ledger.eroded_elements;
    j["crushed_element_steps"] = ledger.crushed;
    j["turned_over_element_steps"] = ledger.turned_over;
    j["inside_without_contact_node_steps"] = ledger.behind;
    j["substeps"] = l.steps;
    j["stable_step_first_s"] = seen.first_step;
    j["stable_step_smallest_over_first"] = seen.first_step > 0 ? seen.least_step / seen.first_step : 1.0;
    all[l.stack.name] = j;
  }
  return all;
}

template <int Dim> std::vector<double> LayersRecord<Dim>::memory() const {
  std::vector<double> numbers;
  for (const Seen& s : seen_) {
    numbers.insert(numbers.end(), {s.largest, s.first_step, s.least_step, s.mass_start, s.largest_internal, s.leak_while_whole, static_cast<double>(s.sides_start.size())});
    for (const std::array<double, 2>& m : s.sides_start) {
      numbers.insert(numbers.end(), m.begin(), m.end());
    }
  }
  return numbers;
}

template <int Dim> std::size_t LayersRecord<Dim>::recall(std::span<const double> numbers) {
  std::size_t at = 0;
  for (Seen& s : seen_) {
    s = {numbers[at], numbers[at + 1], numbers[at + 2], numbers[at + 3], numbers[at + 4], numbers[at + 5], {}};
    const auto materials = static_cast<std::size_t>(numbers[at + 6]);
    at += numbers_of_a_stack;
    for (std::size_t m = 0; m < materials; ++m, at += 2) {
      s.sides_start.push_back({numbers[at], numbers[at + 1]});
    }
  }
  return at;
}

template LayerSums sum_layers<2>(const std::vector<Layers<2>>&);
template LayerSums sum_layers<3>(const std::vector<Layers<3>>&);
template class LayersRecord<2>;
template class LayersRecord<3>;

} // namespace ballast
