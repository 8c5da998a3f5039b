#include "ale/fill.hpp"

#include <cmath>

namespace ballast {

MaterialSlot make_slot(const Material& material, double reference_pressure) {
  MaterialSlot slot;
  slot.material = material;
  GaugeReference& ref = slot.reference;
  ref.rho = material.density;
  ref.e = material.specific_energy;
  ref.p = pressure(material.eos, ref.rho, ref.e);
  const double stiffness = ref.rho * sound_speed_squared(material.eos, ref.rho, ref.e);
  const double offset = ref.p - reference_pressure;
  ref.offset = std::abs(offset) <= 1e-9 * (std::abs(reference_pressure) + 1e-6 * stiffness) ? 0.0 : offset;
  return slot;
}

MaterialSlot make_void() {
  MaterialSlot slot;
  slot.material.name = "void";
  slot.is_void = true;
  return slot;
}

template <int Dim> void fill_cell(Block<Dim>& b, int i, int j, int k, std::span<const CellPart> parts) {
  const int r = b.grid.cell_row(j, k);
  const double volume = b.volume.row(r)[i];
  for (const CellPart& part : parts) {
    if (part.fraction <= 0) {
      continue;
    }
    MaterialSlot& slot = b.materials[static_cast<std::size_t>(part.material)];
    slot.store.allocate(slot.store.tile_of(r));
    slot.store.row(field::fraction, r)[i] = part.fraction;
    if (!slot.is_void) {
      slot.store.row(field::mass, r)[i] = part.density * (part.fraction * volume);
      slot.store.row(field::energy, r)[i] = part.specific_energy;
    }
  }
}

template void fill_cell<2>(Block<2>&, int, int, int, std::span<const CellPart>);
template void fill_cell<3>(Block<3>&, int, int, int, std::span<const CellPart>);

} // namespace ballast
