// summary.json: what a run did and measured, whole.
#include "problems/run_session.hpp"

#include "core/io/summary.hpp"
#include "problems/commands.hpp"
#include "problems/injury_report.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace ballast {

namespace {

/// Energies of viscoelastic materials, and how their nonlinear branches were integrated; empty without any.
template <int Dim> nlohmann::ordered_json tissue_account(const Block<Dim>& b, const Totals& t, const Ledger& l) {
  nlohmann::ordered_json j;
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    if (b.materials[m].memories > 0) {
      const TissueEnergy e = m < l.tissue.size() ? l.tissue[m] : TissueEnergy{};
      j["energy_J"][b.materials[m].material.name] = {
          {"work", e.work}, {"stored", t.free_energy[m]}, {"dissipated", e.dissipated}, {"lost_in_remaps_and_at_interfaces", e.lost}, {"heat_floored", e.floored}};
    }
  }
  if (!j.empty()) {
    const TissueCounts& c = l.tissue_counts;
    j["branch_steps"] = {{"by_1_substep", c.fast[0]}, {"by_2", c.fast[1]}, {"by_4", c.fast[2]}, {"by_8", c.fast[3]},
                         {"by_cvode", c.stiff}, {"above_the_tolerance", c.over - c.stiff < 0 ? 0 : c.over - c.stiff}};
    j["cvode"] = {{"batches", c.cvode.batches}, {"steps", c.cvode.steps}, {"failures", c.cvode.failures}};
    j["seconds_of_all_threads"] = {{"cvode", c.cvode.seconds}, {"fast_path_and_the_rest", c.seconds - c.cvode.seconds}}; // restarts included
    j["worst_estimate"] = c.worst_estimate;
    j["states_repaired"] = l.tissue_repairs;
  }
  return j;
}

} // namespace

template <int Dim> void RunSession<Dim>::summary(const std::string& ended, const std::string& message) {
  using nlohmann::ordered_json;
  const Block<Dim>& b = scene_.blocks[0];
  const Totals t = totals(b);
  const LayerSums layers = sum_layers(scene_.layers);
  const EnergyAccount a = account(t, layers);
  const Ledger& l = scene_.ledger;
  const double wall = seconds_since(start_);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  ordered_json j;
  j["program"] = "ballast";
  j["version"] = version;
  j["title"] = spec_.title;
  j["deck_hash"] = memory_.deck_hash;
  j["ended"] = ended;
  if (!message.empty()) {
    j["message"] = message;
  }
  j["end_time_asked_s"] = clock_.end_time;
  j["end_time_reached_s"] = clock_.time;
  j["cells"] = b.grid.cell_count();
  j["steps"] = clock_.step;
  j["wall_seconds"] = memory_.wall_before + wall;
  j["cell_steps_per_second"] = static_cast<double>(b.grid.cell_count()) * static_cast<double>(clock_.step - start_step_) / std::max(wall, 1e-9);
  j["awake_share"] = b.awake_steps / std::max(1.0, static_cast<double>(clock_.step - start_step_)); // of the cells, mean over the steps
  j["threads"] = scene_.pool->size();
  j["peak_memory_bytes"] = static_cast<double>(usage.ru_maxrss) * 1024;
  j["dt_first_s"] = dt_first_;
  j["dt_smallest_s"] = dt_min_;
  for (std::size_t q = 0; q < clock_.census.size(); ++q) {
    j["dt_limiter_census"][name_of(static_cast<DtCause>(q))] = clock_.census[q];
  }
  double mass_error = 0;
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    if (b.materials[m].is_void) {
      continue;
    }
    const double m0 = memory_.mass_start[m], out = m < l.mass_out.size() ? l.mass_out[m] : 0.0;
    const double error = m0 > 0 ? (t.mass[m] + out - m0) / m0 : 0.0;
    mass_error = std::max(mass_error, std::abs(error));
    j["mass_kg"][b.materials[m].material.name] = {{"start", m0}, {"end", t.mass[m]}, {"left_block", out}, {"relative_error", error},
                                                  {"internal_energy_gain_J", t.internal_energy[m] - memory_.results[m]}};
  }
  std::array<double, 3> momentum = t.momentum;
  for (std::size_t d = 0; d < 3; ++d) {
    momentum[d] += layers.momentum[d];
  }
  j["momentum_kg_m_per_s"] = {{"start", memory_.momentum_start}, {"end", momentum}, {"left_block", l.momentum_out}};
  if (!scene_.layers.empty()) {
    j["momentum_kg_m_per_s"]["given_by_edges_of_layers"] = layers.edge_impulse;
  }
  j["energy_J"] = {{"start", memory_.energy_start}, {"end_total", a.total}, {"end_kinetic", a.kinetic}, {"end_internal", a.internal},
                   {"boundary_work", l.boundary_work}, {"ambient_work", l.ambient_work}, {"void_work", l.void_work},
                   {"remap_kinetic_loss", l.remap_kinetic_loss}, {"remap_kinetic_returned_to_heat", l.remap_kinetic_return},
                   {"sliding_impact", l.sliding_impact},
                   {"left_block", l.energy_out}, {"slivers", l.sliver_energy}, {"unaccounted", a.unaccounted}};
  if (!scene_.layers.empty()) {
    j["wall_seconds_of_layers"] = {{"elements", layers.seconds}, {"contact", layers.contact_seconds}}; // of this run
    j["energy_J"]["lost_by_layers"] = layers.lost + layers.load_work; // in contact, to edges and where their step changed
  }
  if (!scene_.embedded.empty()) {
    j["energy_J"]["lost_where_the_mesh_meets_layers"] = l.embedded_given - layers.load_work; // impacts
  }
  const double energy_scale = std::max(std::abs(memory_.energy_start), 1e-300);
  j["conservation_errors"] = {{"mass_relative", mass_error},
                              {"energy_relative", a.unaccounted / energy_scale}, // but for what the remap lost: that is an entry of the ledger
                              {"remap_loss_not_returned_relative", l.remap_kinetic_loss / energy_scale}};
  j["floors"] = {{"slivers_dropped", l.slivers}, {"sliver_mass_kg", l.sliver_mass}, {"energy_return_cut", l.energy_floors},
                 {"spalled_cells", l.spalled_cells}, {"void_residues_closed", l.closed_voids}, {"step_retries", l.retries}};
  if (const auto tissue = tissue_account(b, t, l); !tissue.empty()) {
    j["tissue"] = tissue;
  }
  const Results& res = spec_.results;
  if (!res.bullet.empty()) {
    const BodyMeasure m = measure_body(b, bullet_slots(), res.shot_axis, res.shot_direction);
    j["results"]["bullet"] = {{"mass_kg", m.mass}, {"velocity_m_per_s", m.velocity}, {"front_m", m.front}, {"rear_m", m.rear}, {"radius_m", m.radius}};
    if (std::isfinite(res.target_face)) {
      j["results"]["bullet"]["depth_m"] = (m.front - res.target_face) * res.shot_direction;
    }
  }
  for (const int axis : lateral_.axes()) {
    const auto d = static_cast<std::size_t>(axis);
    const LateralRecord::State& s = lateral_.state();
    j["results"]["bullet"]["lateral"][std::string(1, "xyz"[d])] = {
        {"deflection_m", s.deflection[d]}, {"momentum_kg_m_per_s", s.momentum[d]},
        {"side_force_N", s.force[d]},      {"side_force_largest_N", s.largest_force[d]},
        {"tilt_rad", s.tilt[d]},           {"yaw_rad", s.yaw[d]},
        {"yaw_largest_rad", s.largest_yaw[d]}};
  }
  if (res.target >= 0) {
    const auto slot = static_cast<std::size_t>(slots_.slot[static_cast<std::size_t>(res.target)]);
    j["results"]["target"] = {{"cavity_radius_largest_m", cavity_peak_},
                              {"internal_energy_gain_J", t.internal_energy[slot] - memory_.results[slot]},
                              {"kinetic_energy_J", kinetic_energy(b, static_cast<int>(slot))}};
  }
  if (!scene_.layers.empty()) {
    j["results"]["layers"] = layers_.results(scene_);
  }
  for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
    j["results"]["gauges"][spec_.gauges[q].name] = {{"peak_pressure_Pa", gauge_peaks_[q]}};
  }
  if (exact_ && clock_.done()) {
    j["exact_solution"] = exact_->law;
    for (const auto& [name, error] : exact_errors(b, *exact_, clock_.time)) {
      j["results"]["exact"][name] = error;
    }
  }
  if (injury_.asked()) {
    j["injury"] = injury_results(spec_, injury_, {memory_.mass_start, slots_.slot});
    fmt::print("{}", injury_lines(j["injury"]));
  }
  io::write_text_atomically(dir_ / "summary.json", j.dump(2) + "\n");
}

template void RunSession<2>::summary(const std::string&, const std::string&);
template void RunSession<3>::summary(const std::string&, const std::string&);

} // namespace ballast
