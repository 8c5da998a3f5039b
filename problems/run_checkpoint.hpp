// Checkpoint of a run: everything the next step reads, so that a restart goes on bit for bit.
#pragma once

#include "ale/simulation.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace ballast {

/// What the run itself must remember besides scene and clock.
struct RunMemory {
  std::string deck_hash;
  double energy_start = 0;
  std::vector<double> mass_start;
  std::array<double, 3> momentum_start = {0, 0, 0};
  std::vector<double> gauges; ///< x, y, z of each
  double next_fields = 0, next_history = 0, wall_before = 0;
  /// What the observer has seen: dt smallest and first, peaks, and each gauge's peak and last velocity.
  std::vector<double> observed;
  std::vector<double> results; ///< scene results measured at the start
};

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Scene<Dim>& scene, const Clock& clock, const RunMemory& memory);

/// Into a scene built from the same deck. Throws Error when the checkpoint is of another deck or shape.
template <int Dim>
void read_checkpoint(const std::filesystem::path& path, Scene<Dim>& scene, Clock& clock, RunMemory& memory);

} // namespace ballast
