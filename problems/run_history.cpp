// What a run measures of itself: the columns of history.csv and their values.
#include "problems/run_session.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

template <int Dim> std::vector<int> RunSession<Dim>::bullet_slots() const {
  std::vector<int> out;
  for (const int body : spec_.results.bullet) {
    const int m = spec_.bodies[static_cast<std::size_t>(body)].material;
    const int slot = m >= 0 ? slots_.slot[static_cast<std::size_t>(m)] : -1;
    if (slot >= 0 && std::find(out.begin(), out.end(), slot) == out.end()) {
      out.push_back(slot);
    }
  }
  return out;
}

template <int Dim> EnergyAccount RunSession<Dim>::account(const Totals& t, const LayerSums& layers) const {
  const Ledger& l = scene_.ledger;
  EnergyAccount a;
  a.kinetic = t.kinetic_energy + layers.kinetic;
  a.internal = t.internal() + layers.internal;
  a.total = a.kinetic + a.internal;
  a.known = l.boundary_work + l.ambient_work + l.void_work - l.remap_kinetic_loss - l.energy_out - l.sliver_energy - layers.lost - l.embedded_given;
  a.unaccounted = a.total - memory_.energy_start - a.known;
  return a;
}

template <int Dim> std::vector<std::string> RunSession<Dim>::columns() const {
  std::vector<std::string> c = {"dt [s]", "energy_kinetic [J]", "energy_internal [J]", "energy_total [J]",
                                "energy_remap_loss [J]", "energy_unaccounted [J]"};
  const char* axes = Dim == 2 && spec_.geometry == Geometry::axisymmetric ? "rz" : "xyz";
  for (int d = 0; d < Dim; ++d) {
    c.push_back(fmt::format("momentum_{} [kg m/s]", axes[d]));
  }
  for (const MaterialSlot& s : scene_.blocks[0].materials) {
    if (!s.is_void) {
      c.push_back(fmt::format("energy_internal_{} [J]", s.material.name));
    }
  }
  if (!spec_.results.bullet.empty()) {
    for (const char* q : {"bullet_velocity [m/s]", "bullet_front [m]", "bullet_rear [m]", "bullet_radius [m]", "bullet_depth [m]"}) {
      c.emplace_back(q);
    }
    for (const std::string& name : spec_.results.bullet_names) {
      for (const char* q : {"front", "rear", "radius"}) {
        c.push_back(fmt::format("{}_{} [m]", name, q));
      }
    }
    const std::vector<std::string> lateral = lateral_.columns();
    c.insert(c.end(), lateral.begin(), lateral.end());
  }
  if (spec_.results.target >= 0) {
    c.emplace_back("cavity_radius [m]");
    c.emplace_back("target_energy_gain [J]");
    c.emplace_back("target_kinetic_energy [J]");
  }
  const std::vector<std::string> layers = layers_.columns(scene_);
  c.insert(c.end(), layers.begin(), layers.end());
  for (const Gauge& g : spec_.gauges) {
    for (const std::string& q : g.record) {
      std::string name = "gauge " + g.name + ": ";
      for (char& letter : name) {
        letter = letter == ',' || letter == '"' || letter == '\n' ? ' ' : letter; // they end a CSV field
      }
      if (q == "velocity" || q == "position" || q == "acceleration") {
        for (int d = 0; d < Dim; ++d) {
          c.push_back(fmt::format("{}{}_{} [{}]", name, q, axes[d], q == "velocity" ? "m/s" : q == "position" ? "m" : "m/s2"));
        }
      } else {
        c.push_back(name + q + (q == "pressure" || q == "deviatoric_stress" ? " [Pa]" : q == "density" ? " [kg/m3]" : q == "specific_energy" ? " [J/kg]" : " [1]"));
      }
    }
  }
  return c;
}

template <int Dim> std::vector<double> RunSession<Dim>::values() {
  const Block<Dim>& b = scene_.blocks[0];
  const Totals t = totals(b);
  const LayerSums layers = sum_layers(scene_.layers);
  const EnergyAccount a = account(t, layers);
  peak_unaccounted_ = std::max(peak_unaccounted_, std::abs(a.unaccounted));
  std::vector<double> v = {clock_.dt, a.kinetic, a.internal, a.total, scene_.ledger.remap_kinetic_loss, a.unaccounted};
  for (std::size_t d = 0; d < Dim; ++d) {
    v.push_back(t.momentum[d] + layers.momentum[d]);
  }
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    if (!b.materials[m].is_void) {
      v.push_back(t.internal_energy[m]);
    }
  }
  const Results& res = spec_.results;
  if (!res.bullet.empty()) {
    const BodyMeasure m = measure_body(b, bullet_slots(), res.shot_axis, res.shot_direction);
    const double depth = std::isfinite(res.target_face) ? std::max(0.0, (m.front - res.target_face) * res.shot_direction) : 0.0;
    v.insert(v.end(), {m.velocity, m.front, m.rear, m.radius, depth});
    for (const int body : res.bullet) {
      const int slot = slots_.slot[static_cast<std::size_t>(spec_.bodies[static_cast<std::size_t>(body)].material)];
      const BodyMeasure part = measure_body(b, {slot}, res.shot_axis, res.shot_direction);
      v.insert(v.end(), {part.front, part.rear, part.radius});
    }
    if (!lateral_.axes().empty()) {
      const std::vector<double> lateral =
          lateral_.add(clock_.time, measure_attitude(b, bullet_slots(), res.shot_axis, res.shot_direction, lateral_.mirrored()));
      v.insert(v.end(), lateral.begin(), lateral.end());
    }
  }
  if (res.target >= 0) {
    const auto slot = static_cast<std::size_t>(slots_.slot[static_cast<std::size_t>(res.target)]);
    const double face = std::isfinite(res.target_face) ? res.target_face : 0.0;
    const double cavity = cavity_radius(b, static_cast<int>(slot), res.shot_axis, face, res.shot_direction, face + res.shot_direction * 1e3);
    cavity_peak_ = std::max(cavity_peak_, cavity);
    v.push_back(cavity);
    v.push_back(t.internal_energy[slot] - memory_.results[slot]);
    v.push_back(kinetic_energy(b, static_cast<int>(slot)));
  }
  const std::vector<double> stacks = layers_.add(scene_);
  v.insert(v.end(), stacks.begin(), stacks.end());
  for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
    const Gauge& g = spec_.gauges[q];
    const std::array<double, 3> at = {memory_.gauges[3 * q], memory_.gauges[3 * q + 1], memory_.gauges[3 * q + 2]};
    const auto cell = find_cell(b, at);
    const int r = b.grid.cell_row(cell[1], cell[2]), i = cell[0];
    const auto u = velocity_at(b, cell, at);
    const double p = b.pressure.row(r)[i] + b.reference_pressure;
    gauge_peaks_[q] = std::max(gauge_peaks_[q], p);
    for (const std::string& name : g.record) {
      for (std::size_t d = 0; d < Dim; ++d) {
        if (name == "velocity") {
          v.push_back(u[d]);
        } else if (name == "position") {
          v.push_back(at[d]);
        } else if (name == "acceleration") {
          const double span = clock_.time - gauge_time_;
          v.push_back(span > 0 ? (u[d] - gauge_velocity_[q][d]) / span : 0.0);
        }
      }
      if (name == "pressure") {
        v.push_back(p);
      } else if (name == "density") {
        v.push_back(b.density.row(r)[i]);
      } else if (name == "specific_energy" || name == "plastic_strain" || name == "damage") {
        const int history = name == "plastic_strain" ? field::plastic_strain<Dim> : name == "damage" ? field::damage<Dim> : field::energy;
        double mass = 0, sum = 0;
        for (const MaterialSlot& s : b.materials) {
          if (s.is_void || (name == "plastic_strain" && !s.strength) || (name == "damage" && !s.damages)) {
            continue;
          }
          const double m = s.store.row(field::mass, r)[i];
          mass += m;
          sum += m * s.store.row(history, r)[i];
        }
        v.push_back(mass > 0 ? sum / mass : 0.0);
      } else if (name == "deviatoric_stress") {
        const double xx = b.any_strength() ? b.stress[0].row(r)[i] : 0, yy = b.any_strength() ? b.stress[1].row(r)[i] : 0;
        double shear = 0;
        for (std::size_t s = 2; b.any_strength() && s < b.stress.size(); ++s) {
          shear += b.stress[s].row(r)[i] * b.stress[s].row(r)[i];
        }
        v.push_back(std::sqrt(1.5 * (xx * xx + yy * yy + (xx + yy) * (xx + yy) + 2 * shear)));
      }
    }
    gauge_velocity_[q] = u;
  }
  gauge_time_ = clock_.time;
  return v;
}

template std::vector<int> RunSession<2>::bullet_slots() const;
template EnergyAccount RunSession<2>::account(const Totals&, const LayerSums&) const;
template std::vector<std::string> RunSession<2>::columns() const;
template std::vector<double> RunSession<2>::values();
template std::vector<int> RunSession<3>::bullet_slots() const;
template EnergyAccount RunSession<3>::account(const Totals&, const LayerSums&) const;
template std::vector<std::string> RunSession<3>::columns() const;
template std::vector<double> RunSession<3>::values();

} // namespace ballast
