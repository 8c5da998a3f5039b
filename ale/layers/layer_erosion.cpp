#include "ale/layers/layer_erosion.hpp"

namespace ballast {
namespace {

template <int Dim> bool is_lost(const LayerStack<Dim>& s, const std::array<double, 2>& at, std::size_t e) {
  bool lost = true;
  for (std::size_t point = 0; point < 2 && lost; ++point) {
    for (std::size_t family = 0; family < 2 && lost; ++family) {
      lost = s.largest[point][family][e] >= at[family];
    }
  }
  return lost;
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
}

template void erode<2>(LayerStack<2>&, const std::array<double, 2>&, LayerLedger&);
template void erode<3>(LayerStack<3>&, const std::array<double, 2>&, LayerLedger&);

} // namespace ballast
