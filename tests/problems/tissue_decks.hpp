// Decks with viscoelastic tissue, and the bits of what a step leaves.
#pragma once

#include "ale/scene.hpp"

#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace ballast {

inline constexpr const char* prony = R"(strength = "prony"
long_shear = "0.2 MPa"
branch_shear = ["0.2 MPa", "1 MPa"]
branch_time = ["1e6 s", "20 us"]
)";
inline constexpr const char* power_law = R"(strength = "power_law"
long_shear = "10 kPa"
branch_shear = ["2 MPa", "1 MPa"]
branch_time = ["2 ns", "1 us"]
branch_reference = ["0.1 MPa", "0.1 MPa"]
branch_exponent = [3, 2]
)";
inline constexpr const char* fung = R"(strength = "fung"
shear_modulus = "0.5 MPa"
stiffening = 3
branch_share = [0.5, 0.3]
branch_time = ["2 us", "100 us"]
)";
inline constexpr const char* boyce = R"(strength = "bergstroem_boyce"
network_a_shear = "0.1 MPa"
network_b_shear = "0.5 MPa"
flow_rate = "1e4 1/s"
flow_stress = "50 kPa"
flow_exponent = 4
)";

/// Bits of velocities, positions and all that materials keep, where they are.
template <int Dim> std::vector<std::uint64_t> bits_of(const Scene<Dim>& scene) {
  std::vector<std::uint64_t> out;
  const auto put = [&](double v) { out.push_back(std::bit_cast<std::uint64_t>(v)); };
  const Block<Dim>& b = scene.blocks[0];
  for (int k = 0; k < (Dim == 3 ? b.grid.cells[2] + 1 : 1); ++k) {
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        for (std::size_t d = 0; d < Dim; ++d) {
          put(b.velocity[d].row(b.grid.node_row(j, k))[i]);
          put(b.position[d].row(b.grid.node_row(j, k))[i]);
        }
      }
    }
  }
  for (int k = 0; k < b.grid.cells[2]; ++k) {
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      for (int i = 0; i < b.grid.cells[0]; ++i) {
        for (const MaterialSlot& s : b.materials) {
          const int r = b.grid.cell_row(j, k);
          for (int f = 0; f < s.store.conserved() && s.store.row(field::fraction, r)[i] > 0; ++f) {
            put(s.store.row(f, r)[i]);
          }
        }
      }
    }
  }
  for (const TissueEnergy& e : scene.ledger.tissue) {
    put(e.work);
    put(e.dissipated);
    put(e.lost);
    put(e.floored);
  }
  for (const long n : scene.ledger.tissue_counts.fast) {
    put(static_cast<double>(n));
  }
  put(static_cast<double>(scene.ledger.tissue_counts.stiff));
  return out;
}

/// A ball of lead flies into tissue, `path` by numerics.tissue_path.
inline std::string impact(const std::string& law, const std::string& path, const char* geometry = "axisymmetric") {
  const bool space = std::string(geometry) == "3d";
  const std::string mesh = space ? R"(
x = { from = "0 mm", to = "9 mm", size = "1 mm" }
y = { from = "0 mm", to = "9 mm", size = "1 mm" }
z = { from = "-7 mm", to = "10 mm", size = "1 mm" })"
                                 : R"(
r = { from = "0 mm", to = "14 mm", size = "0.7 mm" }
z = { from = "-7 mm", to = "16 mm", size = "0.7 mm" })";
  return fmt::format(R"(
title = "impact"
geometry = "{}"
end_time = "{}"
{}
[[body]]
name = "ball"
material = "lead"
shape = {{ sphere = {{ centre = [{}], radius = "3 mm" }} }}
velocity = [{}]
[[body]]
name = "tissue"
material = "flesh"
shape = {{ box = {{ from = [{}], to = [{}] }} }}
[materials.flesh]
base = "muscle"
{}
[numerics]
tissue_path = "{}"
tissue_tolerance = 1e-4
[mesh]{}
)",
                     geometry, space ? "3 us" : "8 us", space ? R"(symmetry = ["x", "y"])" : "", space ? R"("0 mm", "0 mm", "-3.5 mm")" : R"("0 mm", "-3.5 mm")",
                     space ? R"("0 m/s", "0 m/s", "500 m/s")" : R"("0 m/s", "500 m/s")", space ? R"("0 mm", "0 mm", "0 mm")" : R"("0 mm", "0 mm")",
                     space ? R"("9 mm", "9 mm", "10 mm")" : R"("14 mm", "16 mm")", law, path, mesh);
}

} // namespace ballast
