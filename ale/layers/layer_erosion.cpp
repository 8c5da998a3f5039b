#include "ale/layers/layer_erosion.hpp"

namespace ballast {
namespace {

template <int Dim> bool is_lost(const LayerStack<Dim>& s, const std::array<double, 2>& at, std::size_t e) {
  const auto family_lost = [&](std::size_t f) { return s.largest[0][f][e] >= at[f] && s.largest[1][f][e] >= at[f]; };
  return s.guard.either ? family_lost(0) || family_lost(1) : family_lost(0) && family_lost(1);
}

/// Does an element still hang on another of its layer?
template <int Dim> bool hangs(const LayerStack<Dim>& s, int i, int j, int level) {
  const auto there = [&](int p, int q) { return p >= 0 && q >= 0 && p < s.grid.elements[0] && q < s.grid.elements[1] && s.alive[s.element(p, q, level)] != 0; };
  return there(i - 1, j) || there(i + 1, j) || there(i, j - 1) || there(i, j + 1);
}

/// What torn elements leave alone is debris.
template <int Dim> void erode_islands(LayerStack<Dim>& s, LayerLedger& ledger) {
  std::vector<std::size_t> alone;
  for (int level = 0; level < s.grid.levels(); ++level) {
    for (int j = 0; j < s.grid.elements[1]; ++j) {
      for (int i = 0; i < s.grid.elements[0]; ++i) {
        const std::size_t e = s.element(i, j, level);
        if (s.alive[e] != 0 && !hangs(s, i, j, level)) {
          alone.push_back(e);
        }
      }
    }
  }
  for (const std::size_t e : alone) {
    s.alive[e] = 0;
    ledger.eroded_energy += s.energy[e];
    ++ledger.eroded_elements;
  }
}

} // namespace

template <int Dim> void erode(LayerStack<Dim>& s, const std::array<double, 2>& lost_at, LayerLedger& ledger) {
  const int through = s.grid.through;
  const std::size_t level = s.element_count() / static_cast<std::size_t>(s.grid.levels());
  for (int layer = 0; layer < s.grid.layers; ++layer) {
    const std::size_t first = s.element(0, 0, layer * through);
    for (std::size_t e = first; e < first + level; ++e) {
      int lost = 0;
      while (lost < through && s.alive[e] != 0 && is_lost(s, lost_at, e + static_cast<std::size_t>(lost) * level)) {
        ++lost;
      }
      for (int l = 0; l < through && lost == through; ++l) {
        const std::size_t k = e + static_cast<std::size_t>(l) * level;
        s.alive[k] = 0;
        ledger.eroded_energy += s.energy[k];
        ++ledger.eroded_elements;
      }
    }
  }
  if ((s.guard.torn > 0 || s.guard.either) && s.grid.elements[0] * s.grid.elements[1] > 1) {
    erode_islands(s, ledger);
  }
}

template void erode<2>(LayerStack<2>&, const std::array<double, 2>&, LayerLedger&);
template void erode<3>(LayerStack<3>&, const std::array<double, 2>&, LayerLedger&);

} // namespace ballast
