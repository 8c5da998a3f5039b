// A run in progress: its directory, what it measures and writes between steps.
#pragma once

#include "core/io/history.hpp"
#include "core/io/vtk.hpp"
#include "problems/exact_solution.hpp"
#include "problems/injury_record.hpp"
#include "problems/run_checkpoint.hpp"
#include "problems/run_attitude.hpp"
#include "problems/run_layers.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

namespace ballast {

/// Sums of a scene and what is not accounted for, at one time.
struct EnergyAccount {
  double kinetic = 0, internal = 0, total = 0;
  double known = 0;       ///< every ledger entry since the start
  double unaccounted = 0; ///< total - start - known
};

/// Of the resolved deck, FNV-1a 64 bit: tells decks apart, no more.
std::string deck_hash(const ReadScene& read);

/// Wall clock, s.
double seconds_since(std::chrono::steady_clock::time_point t);

template <int Dim> class RunSession : public Observer<Dim> {
public:
  RunSession(const ReadScene& read, const std::filesystem::path& dir, int threads, const std::string& restart, const ExactSolver& exact = {});

  /// Runs to the end, an interrupt or a failure; writes everything. Returns the exit status.
  int run();
  bool record(const Scene<Dim>& scene, const Clock& clock) override;

private:
  void sample();
  void dump();
  void progress(bool last);
  void move_gauges();
  void checkpoint();
  void summary(const std::string& ended, const std::string& message);
  std::vector<std::string> columns() const;
  std::vector<double> values();
  EnergyAccount account(const Totals& totals, const LayerSums& layers) const;
  std::vector<int> bullet_slots() const;

  const ReadScene& read_;
  const SceneSpec& spec_;
  std::filesystem::path dir_;
  Scene<Dim> scene_;
  Clock clock_;
  RunMemory memory_;
  SlotMap slots_;
  std::optional<io::HistoryWriter> history_;
  std::optional<io::VtkSeries> series_;
  std::optional<ExactSolution> exact_;
  bool restarted_ = false, terminal_ = false;
  long start_step_ = 0;
  double dt_min_ = 1e300, dt_first_ = 0, peak_unaccounted_ = 0, cavity_peak_ = 0;
  std::vector<double> gauge_peaks_;
  std::vector<std::array<double, 3>> gauge_velocity_;
  double gauge_time_ = 0;
  LateralRecord lateral_;
  LayersRecord<Dim> layers_;
  InjuryRecord<Dim> injury_;
  std::chrono::steady_clock::time_point start_, last_progress_, last_checkpoint_;
};

} // namespace ballast
