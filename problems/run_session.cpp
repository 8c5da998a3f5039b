#include "problems/run_session.hpp"

#include "core/error.hpp"
#include "core/io/summary.hpp"
#include "problems/commands.hpp"
#include "problems/layers_dump.hpp"
#include "problems/run_dump.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace ballast {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void on_signal(int) { interrupted = 1; }

constexpr double progress_every = 2;       // s on a terminal
constexpr double plain_progress_every = 15; // s else

} // namespace

std::string deck_hash(const ReadScene& read) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const char c : read.resolved) {
    h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{:016x}", h);
}

double seconds_since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

template <int Dim>
RunSession<Dim>::RunSession(const ReadScene& read, const std::filesystem::path& dir, int threads, const std::string& restart, const ExactSolver& exact)
    : read_(read), spec_(read.scene), dir_(dir), scene_(build_scene<Dim>(read.scene, threads)), slots_(slot_map(read.scene)),
      restarted_(!restart.empty()), terminal_(isatty(STDOUT_FILENO) != 0), lateral_(read.scene), layers_(read.scene),
      injury_(read.scene, slots_.slot) {
  clock_.end_time = spec_.end_time;
  memory_.deck_hash = deck_hash(read);
  if (restarted_) {
    read_checkpoint(restart, scene_, clock_, memory_);
    const auto& o = memory_.observed;
    const std::size_t lateral_at = 5 + 4 * spec_.gauges.size();
    if (o.size() < lateral_at + lateral_.memory().size() + layers_.memory().size() + injury_.memory().size()) { // what stacks remember may be more
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
    const std::size_t layers_at = lateral_at + lateral_.recall(std::span(o).subspan(lateral_at));
    const std::size_t injury_at = layers_at + layers_.recall(std::span(o).subspan(layers_at));
    injury_.recall(std::span(o).subspan(injury_at));
  } else {
    const Totals t = totals(scene_.blocks[0]);
    const LayerSums layers = sum_layers(scene_.layers);
    memory_.energy_start = t.internal() + t.kinetic_energy + layers.kinetic + layers.internal;
    memory_.mass_start = t.mass;
    memory_.momentum_start = t.momentum;
    for (std::size_t d = 0; d < 3; ++d) {
      memory_.momentum_start[d] += layers.momentum[d];
    }
    memory_.results = t.internal_energy;
    for (const Gauge& g : spec_.gauges) {
      memory_.gauges.insert(memory_.gauges.end(), g.at.begin(), g.at.end());
    }
  }
  std::string why_not;
  exact_ = exact ? exact(spec_, why_not) : std::nullopt;
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

template <int Dim> void RunSession<Dim>::sample() { history_->add(clock_.time, values()); }

template <int Dim> void RunSession<Dim>::dump() {
  std::vector<io::GridDump> dumps;
  for (const Block<Dim>& b : scene_.blocks) {
    dumps.push_back(dump_block(b, scene_.numerics.normal, spec_.output.fields));
  }
  const std::vector<std::string> names = dumps.front().material_names;
  std::vector<const LayerStack<Dim>*> stacks;
  for (const Layers<Dim>& l : scene_.layers) {
    stacks.push_back(&l.stack);
  }
  const int index = series_->next_index();
  series_->write(clock_.time, index, dumps, dump_layers<Dim>(stacks, names));
  layers_.write_back_faces(scene_, dir_, index);
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
  const std::vector<double> lateral = lateral_.memory();
  memory.observed.insert(memory.observed.end(), lateral.begin(), lateral.end());
  const std::vector<double> layers = layers_.memory();
  memory.observed.insert(memory.observed.end(), layers.begin(), layers.end());
  const std::vector<double> injury = injury_.memory();
  memory.observed.insert(memory.observed.end(), injury.begin(), injury.end());
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
  layers_.step(scene_);
  injury_.step(scene_, clock_.time, memory_.gauges);
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

template <int Dim> int RunSession<Dim>::run() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  start_ = last_progress_ = last_checkpoint_ = std::chrono::steady_clock::now();
  if (!restarted_) {
    layers_.step(scene_);
    injury_.step(scene_, clock_.time, memory_.gauges);
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
