#include "problems/run_session.hpp"

#include "core/error.hpp"
#include "core/io/summary.hpp"
#include "problems/commands.hpp"
#include "problems/run_dump.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace ballast {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void on_signal(int) { interrupted = 1; }

double seconds_since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

/// FNV-1a, 64 bit: tells decks apart, no more.
std::string hash_of(const std::string& text) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const char c : text) {
    h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{:016x}", h);
}

constexpr double progress_every = 2;       // s on a terminal
constexpr double plain_progress_every = 15; // s else

} // namespace

template <int Dim>
RunSession<Dim>::RunSession(const ReadScene& read, const std::filesystem::path& dir, int threads, const std::string& restart)
    : read_(read), spec_(read.scene), dir_(dir), scene_(build_scene<Dim>(read.scene, threads)), slots_(slot_map(read.scene)),
      restarted_(!restart.empty()), terminal_(isatty(STDOUT_FILENO) != 0) {
  clock_.end_time = spec_.end_time;
  memory_.deck_hash = hash_of(read.resolved);
  if (restarted_) {
    read_checkpoint(restart, scene_, clock_, memory_);
    const auto& o = memory_.observed;
    if (o.size() != 5 + 4 * spec_.gauges.size()) {
      throw Error(restart + ": the state of a failed run, kept for inspection; restart from a checkpoint.h5 before it");
    }
    dt_min_ = o.at(0);
    dt_first_ = o.at(1);
    peak_unaccounted_ = o.at(2);
    cavity_peak_ = o.at(3);
    gauge_time_ = o.at(4);
    for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
      gauge_peaks_.push_back(o.at(5 + 4 * q));
      gauge_velocity_.push_back({o.at(6 + 4 * q), o.at(7 + 4 * q), o.at(8 + 4 * q)});
    }
  } else {
    const Totals t = totals(scene_.blocks[0]);
    memory_.energy_start = t.internal() + t.kinetic_energy;
    memory_.mass_start = t.mass;
    memory_.momentum_start = t.momentum;
    memory_.results = t.internal_energy;
    for (const Gauge& g : spec_.gauges) {
      memory_.gauges.insert(memory_.gauges.end(), g.at.begin(), g.at.end());
    }
  }
  gauge_peaks_.resize(spec_.gauges.size(), 0.0);
  gauge_velocity_.resize(spec_.gauges.size(), {0, 0, 0});
  std::filesystem::create_directories(dir_);
  io::write_text_atomically(dir_ / "deck.toml", read.resolved);
  const auto names = columns();
  history_.emplace(restarted_ ? io::HistoryWriter::reopen(dir_ / "history.csv", names, clock_.time * (1 + 1e-12))
                              : io::HistoryWriter(dir_ / "history.csv", names));
  series_.emplace(dir_, "fields");
  if (restarted_) {
    series_->keep_until(clock_.time * (1 + 1e-12));
  }
  start_step_ = clock_.step;
}

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

template <int Dim> EnergyAccount RunSession<Dim>::account() const {
  const Totals t = totals(scene_.blocks[0]);
  const Ledger& l = scene_.ledger;
  EnergyAccount a;
  a.kinetic = t.kinetic_energy;
  a.internal = t.internal();
  a.total = a.kinetic + a.internal;
  a.known = l.boundary_work + l.ambient_work + l.void_work - l.remap_kinetic_loss - l.energy_out - l.sliver_energy;
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
  }
  if (spec_.results.target >= 0) {
    c.emplace_back("cavity_radius [m]");
    c.emplace_back("target_energy_gain [J]");
  }
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
  const EnergyAccount a = account();
  peak_unaccounted_ = std::max(peak_unaccounted_, std::abs(a.unaccounted));
  std::vector<double> v = {clock_.dt, a.kinetic, a.internal, a.total, scene_.ledger.remap_kinetic_loss, a.unaccounted};
  for (std::size_t d = 0; d < Dim; ++d) {
    v.push_back(t.momentum[d]);
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
  }
  if (res.target >= 0) {
    const auto slot = static_cast<std::size_t>(slots_.slot[static_cast<std::size_t>(res.target)]);
    const double face = std::isfinite(res.target_face) ? res.target_face : 0.0;
    const double cavity = cavity_radius(b, static_cast<int>(slot), res.shot_axis, face, res.shot_direction, face + res.shot_direction * 1e3);
    cavity_peak_ = std::max(cavity_peak_, cavity);
    v.push_back(cavity);
    v.push_back(t.internal_energy[slot] - memory_.results[slot]);
  }
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
      } else if (name == "specific_energy" || name == "plastic_strain") {
        double mass = 0, sum = 0;
        for (const MaterialSlot& s : b.materials) {
          if (s.is_void || (name == "plastic_strain" && !s.strength)) {
            continue;
          }
          const double m = s.store.row(field::mass, r)[i];
          mass += m;
          sum += m * s.store.row(name == "plastic_strain" ? field::plastic_strain<Dim> : field::energy, r)[i];
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

template <int Dim> void RunSession<Dim>::sample() { history_->add(clock_.time, values()); }

template <int Dim> void RunSession<Dim>::dump() {
  std::vector<io::GridDump> dumps;
  for (const Block<Dim>& b : scene_.blocks) {
    dumps.push_back(dump_block(b, scene_.numerics.normal, spec_.output.fields));
  }
  series_->write(clock_.time, series_->next_index(), dumps);
}

template <int Dim> void RunSession<Dim>::move_gauges() {
  for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
    if (!spec_.gauges[q].rides) {
      continue;
    }
    const std::array<double, 3> at = {memory_.gauges[3 * q], memory_.gauges[3 * q + 1], memory_.gauges[3 * q + 2]};
    const auto u = velocity_at(scene_.blocks[0], find_cell(scene_.blocks[0], at), at);
    for (std::size_t d = 0; d < Dim; ++d) {
      memory_.gauges[3 * q + d] += clock_.dt * u[d];
    }
  }
}

template <int Dim> void RunSession<Dim>::checkpoint() {
  RunMemory memory = memory_;
  memory.wall_before += seconds_since(start_);
  memory.observed = {dt_min_, dt_first_, peak_unaccounted_, cavity_peak_, gauge_time_};
  for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
    memory.observed.insert(memory.observed.end(), {gauge_peaks_[q], gauge_velocity_[q][0], gauge_velocity_[q][1], gauge_velocity_[q][2]});
  }
  write_checkpoint(dir_ / "checkpoint.h5", scene_, clock_, memory);
  last_checkpoint_ = std::chrono::steady_clock::now();
}

template <int Dim> void RunSession<Dim>::progress(bool last) {
  const double wall = seconds_since(start_), part = clock_.time / clock_.end_time;
  const double eta = part > 0 && clock_.step > start_step_ ? wall * (1 - part) / part : 0;
  const Block<Dim>& b = scene_.blocks[static_cast<std::size_t>(clock_.limit.block)];
  const auto& c = clock_.limit.cell;
  const std::string where = c[0] >= 0 ? fmt::format(" ({}, cell {} {} {}{})", b.name, c[0], c[1], c[2],
                                                    clock_.limit.material >= 0 ? ", " + b.materials[static_cast<std::size_t>(clock_.limit.material)].material.name : "")
                                      : "";
  const std::string line = fmt::format("{:5.1f} %  t {:.3e} s  step {}  dt {:.2e} s by {}{}  {:.0f} s, about {:.0f} s left", 100 * part, clock_.time,
                                       clock_.step, clock_.dt, name_of(clock_.limit.cause), where, wall, eta);
  if (terminal_) {
    fmt::print("\r\033[K{}{}", line, last ? "\n" : "");
  } else {
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
  last_progress_ = std::chrono::steady_clock::now();
}

template <int Dim> bool RunSession<Dim>::record(const Scene<Dim>&, const Clock&) {
  dt_min_ = clock_.limit.cause == DtCause::end ? dt_min_ : std::min(dt_min_, clock_.dt);
  dt_first_ = dt_first_ == 0 ? clock_.dt : dt_first_;
  move_gauges();
  const bool end = clock_.done();
  if (spec_.output.history_every <= 0 || clock_.time >= memory_.next_history || end) {
    sample();
    while (spec_.output.history_every > 0 && memory_.next_history <= clock_.time) {
      memory_.next_history += spec_.output.history_every;
    }
  }
  if (clock_.time >= memory_.next_fields || end) {
    dump();
    while (memory_.next_fields <= clock_.time) {
      memory_.next_fields += spec_.output.fields_every;
    }
  }
  if (seconds_since(last_progress_) > (terminal_ ? progress_every : plain_progress_every)) {
    progress(false);
  }
  if (seconds_since(last_checkpoint_) > spec_.output.checkpoint_every) {
    checkpoint();
  }
  return interrupted == 0;
}

template <int Dim> void RunSession<Dim>::summary(const std::string& ended, const std::string& message) {
  using nlohmann::ordered_json;
  const Block<Dim>& b = scene_.blocks[0];
  const Totals t = totals(b);
  const EnergyAccount a = account();
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
  j["momentum_kg_m_per_s"] = {{"start", memory_.momentum_start}, {"end", t.momentum}, {"left_block", l.momentum_out}};
  j["energy_J"] = {{"start", memory_.energy_start}, {"end_total", a.total}, {"end_kinetic", a.kinetic}, {"end_internal", a.internal},
                   {"boundary_work", l.boundary_work}, {"ambient_work", l.ambient_work}, {"void_work", l.void_work},
                   {"remap_kinetic_loss", l.remap_kinetic_loss}, {"remap_kinetic_returned_to_heat", l.remap_kinetic_return},
                   {"left_block", l.energy_out}, {"slivers", l.sliver_energy}, {"unaccounted", a.unaccounted}};
  j["conservation_errors"] = {{"mass_relative", mass_error},
                              {"energy_relative", a.unaccounted / std::max(std::abs(memory_.energy_start), 1e-300)}};
  j["floors"] = {{"slivers_dropped", l.slivers}, {"sliver_mass_kg", l.sliver_mass}, {"energy_return_cut", l.energy_floors},
                 {"spalled_cells", l.spalled_cells}, {"void_residues_closed", l.closed_voids}, {"step_retries", l.retries}};
  const Results& res = spec_.results;
  if (!res.bullet.empty()) {
    const BodyMeasure m = measure_body(b, bullet_slots(), res.shot_axis, res.shot_direction);
    j["results"]["bullet"] = {{"mass_kg", m.mass}, {"velocity_m_per_s", m.velocity}, {"front_m", m.front}, {"rear_m", m.rear}, {"radius_m", m.radius}};
    if (std::isfinite(res.target_face)) {
      j["results"]["bullet"]["depth_m"] = (m.front - res.target_face) * res.shot_direction;
    }
  }
  if (res.target >= 0) {
    const auto slot = static_cast<std::size_t>(slots_.slot[static_cast<std::size_t>(res.target)]);
    j["results"]["target"] = {{"cavity_radius_largest_m", cavity_peak_}, {"internal_energy_gain_J", t.internal_energy[slot] - memory_.results[slot]}};
  }
  for (std::size_t q = 0; q < spec_.gauges.size(); ++q) {
    j["results"]["gauges"][spec_.gauges[q].name] = {{"peak_pressure_Pa", gauge_peaks_[q]}};
  }
  io::write_text_atomically(dir_ / "summary.json", j.dump(2) + "\n");
}

template <int Dim> int RunSession<Dim>::run() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  start_ = last_progress_ = last_checkpoint_ = std::chrono::steady_clock::now();
  if (!restarted_) {
    sample();
    dump();
    memory_.next_history = spec_.output.history_every;
    memory_.next_fields = spec_.output.fields_every;
  }
  try {
    const bool finished = ballast::run(scene_, clock_, std::vector<Observer<Dim>*>{this});
    progress(true);
    checkpoint();
    summary(finished ? "finished" : "interrupted", "");
    if (!finished) {
      fmt::print("interrupted; go on with --restart {}\n", (dir_ / "checkpoint.h5").string());
    }
    return static_cast<int>(finished ? ExitStatus::finished : ExitStatus::interrupted);
  } catch (const NumericalFailure& failure) {
    write_checkpoint(dir_ / "failed.h5", scene_, clock_, memory_);
    summary("failed", failure.what());
    fmt::print(stderr, "\nballast: numerical failure: {}\nstate saved in {}\n", failure.what(), (dir_ / "failed.h5").string());
    return static_cast<int>(ExitStatus::numerical_failure);
  }
}

template class RunSession<2>;
template class RunSession<3>;

} // namespace ballast
