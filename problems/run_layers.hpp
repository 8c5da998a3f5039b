// What a run measures of its stacks of fabric layers: sums for its account, columns of history.csv, results of summary.json.
#pragma once

#include "ale/scene.hpp"
#include "problems/scene_spec.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace ballast {

/// Sums over all stacks. Energies are those of their account (ale/layers/layer_account), J.
struct LayerSums {
  double mass = 0;    ///< kg
  double kinetic = 0; ///< leapfrog's
  double internal = 0; ///< of the elements' stresses and of their stabilisation
  double lost = 0;    ///< to edges, in contact, where the step changed, less load_work: kinetic + internal + lost keeps
  double load_work = 0; ///< done on them by a mesh that they lie in
  std::array<double, 3> momentum = {0, 0, 0};     ///< kg m/s
  std::array<double, 3> edge_impulse = {0, 0, 0}; ///< given to the stacks by held edges
  double seconds = 0, contact_seconds = 0;        ///< on the wall, this run
};
template <int Dim> LayerSums sum_layers(const std::vector<Layers<Dim>>& layers);

/// Follows the stacks of a scene from step to step; what it remembers goes through checkpoints.
template <int Dim> class LayersRecord {
public:
  explicit LayersRecord(const SceneSpec& scene) : spec_(scene), seen_(scene.layers.size()) {}
  std::vector<std::string> columns(const Scene<Dim>& scene) const;
  /// Values of the columns now.
  std::vector<double> add(const Scene<Dim>& scene);
  /// After every step, and at the start.
  void step(const Scene<Dim>& scene);
  /// Writes the back faces beside the dump `index`.
  void write_back_faces(const Scene<Dim>& scene, const std::filesystem::path& dir, int index) const;
  /// By the stacks' names; null without any.
  nlohmann::ordered_json results(const Scene<Dim>& scene) const;
  std::vector<double> memory() const;
  /// The inverse; returns how many numbers it took.
  std::size_t recall(std::span<const double> numbers);

private:
  struct Seen {
    double largest = 0;                   ///< deflection of any node of the back face at any sample, m
    double first_step = 0, least_step = 0; ///< stable steps of the stack, s
    double mass_start = 0;                ///< kg
    double largest_internal = 0;          ///< J: at any sample
    // Of a stack inside the mesh: kg by material and side at the start, largest mass that has changed sides while a layer was whole.
    double leak_while_whole = 0;
    std::vector<std::array<double, 2>> sides_start = {};
  };
  static std::array<double, 2> passed(const Scene<Dim>& scene, const Seen& seen, const std::vector<std::array<double, 2>>& now);
  const SceneSpec& spec_;
  std::vector<Seen> seen_;
};

} // namespace ballast
