#include "ale/tissue_half.hpp"

#include "ale/tissue_update.hpp"
#include "materials/visco_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace ballast {

namespace {

struct HalfBranch {
  double gone = 0;   ///< 1 - exp(-x)
  double weight = 0; ///< of the branch's stress; Fung: its share
};

/// A law at the half step.
struct HalfLaw {
  std::array<HalfBranch, most_visco_branches> branch{};
  std::size_t branches = 0;
  double shear = 0;              ///< Pa, of what is strained until then
  const FungQlv* fung = nullptr; ///< null: Prony
};

/// False: no tissue, or a law whose rate depends on the stress.
bool half_of(const MaterialSlot& slot, double dt, HalfLaw& half) {
  const TissueLaw* law = slot.memories > 0 ? tissue_law(slot.material.strength) : nullptr;
  if (law == nullptr) {
    return false;
  }
  half = {};
  half.shear = slot.shear;
  const auto add = [&](double time, double weight, double shear) {
    const Relaxation r = relaxation(0.5 * dt / time);
    half.branch[half.branches++] = {-std::expm1(-0.5 * dt / time), weight};
    half.shear = std::max(0.0, half.shear - shear * (1 - r.share)); // not round-off below it
  };
  if (const auto* prony = std::get_if<Prony>(law)) {
    for (const PronyBranch& b : std::span(prony->branch).first(prony->branches)) {
      add(b.time, 1, b.shear);
    }
    return true;
  }
  half.fung = std::get_if<FungQlv>(law);
  for (std::size_t b = 0; half.fung != nullptr && b < half.fung->branches; ++b) {
    add(half.fung->branch[b].time, half.fung->branch[b].share, half.fung->branch[b].share * half.fung->shear);
  }
  return half.fung != nullptr;
}

/// Cells [begin, end) of row r.
template <int Dim> void relax_run(Block<Dim>& b, const MaterialSlot& slot, const HalfLaw& half, int r, int begin, int end) {
  constexpr auto component = stress_of_tensor<Dim>();
  const auto memory = [&](std::size_t tensor, std::size_t a) { return slot.store.row(field::memory<Dim> + static_cast<int>(tensor * memory_components<Dim> + a), r); };
  const double* density = b.density.row(r);
  std::fill(b.shear.row(r) + begin, b.shear.row(r) + end, half.shear);
  for (std::size_t a = 0; a < component.size(); ++a) {
    const double* start = slot.store.row(field::stress + static_cast<int>(a), r);
    std::copy(start + begin, start + end, b.stress[a].row(r) + begin);
  }
  for (std::size_t n = 0; n < half.branches; ++n) {
    const double per_density = half.branch[n].weight * half.branch[n].gone / slot.material.density; // 1/J is density over the initial one
    for (std::size_t a = 0; a < component.size(); ++a) {
      const double* q = memory(n + 1, component[a]);
      double* s = b.stress[a].row(r);
#pragma omp simd
      for (int i = begin; i < end; ++i) {
        s[i] += (half.fung == nullptr ? -1 : 1) * per_density * density[i] * q[i];
      }
    }
  }
  if (half.fung == nullptr) {
    return;
  }
  double gone = 0;
  for (const HalfBranch& n : half.branch) {
    gone += n.weight * n.gone;
  }
  for (int i = begin; i < end; ++i) {
    double square = 0;
    for (std::size_t a = 0; a < memory_components<Dim>; ++a) {
      square += (a < 3 ? 1 : 2) * memory(0, a)[i] * memory(0, a)[i];
    }
    const double elastic = 2 * half.fung->shear * std::exp(half.fung->stiffening * square) * gone * density[i] / slot.material.density;
    for (std::size_t a = 0; a < component.size(); ++a) {
      b.stress[a].row(r)[i] -= elastic * memory(0, component[a])[i];
    }
  }
}

} // namespace

template <int Dim> void relax_to_half(Scene<Dim>& scene, double dt) {
  for (Block<Dim>& b : scene.blocks) {
    std::vector<HalfLaw> laws(b.materials.size());
    std::vector<char> relaxes;
    for (std::size_t m = 0; m < b.materials.size(); ++m) {
      relaxes.push_back(half_of(b.materials[m], dt, laws[m]) ? 1 : 0);
    }
    if (std::count(relaxes.begin(), relaxes.end(), 1) == 0) {
      continue;
    }
    parallel_awake(*scene.pool, &b.awake, b.grid.slabs(), [&](int begin, int end, int) {
      RowRuns runs;
      for (int s = begin; s < end; ++s) {
        for (int q = 0; q < b.grid.rows_per_slab(); ++q) {
          const auto [j, k] = b.grid.in_slab(s, q);
          const int r = b.grid.cell_row(j, k);
          const Span cells = b.awake.cells(r);
          if (cells.empty()) {
            continue;
          }
          runs.scan(b.owner_row(r), cells);
          for (const RowRuns::Run& run : runs.pure) {
            const auto m = static_cast<std::size_t>(run.material);
            if (relaxes[m] != 0) {
              relax_run(b, b.materials[m], laws[m], r, run.begin, run.end);
            }
          }
        }
      }
    });
  }
}

template void relax_to_half<2>(Scene<2>&, double);
template void relax_to_half<3>(Scene<3>&, double);

} // namespace ballast
