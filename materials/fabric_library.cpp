#include "materials/fabric_library.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double areal_density = 1440 * 3.63e-3; // kg/m2, of the paper's section 2
constexpr int vest_plies = 29;                   // of 0.180 kg/m2
constexpr double ply_thickness = 0.23e-3;        // m

FabricMaterial kevlar_km2_raftenberg() {
  constexpr double thickness = vest_plies * ply_thickness;
  return {.name = "kevlar_km2_raftenberg",
          .model = RaftenbergFabric{
              .warp = {.fit = {.a = 1.35322e9, .b = -98.8705e9, .c = 2727.95e9, .d = -4898.41e9, .e = -22.0527, .f = 465.297},
                       .rupture = 0.132930,
                       .unload = 0.4},
              .fill = {.fit = {.a = 1.79587e9, .b = -204.612e9, .c = 14539.8e9, .d = -33428.5e9, .e = -34.3400, .f = 2137.94},
                       .rupture = 0.149961,
                       .unload = 0.4},
              .transverse = {.a = 1.25770e6, .b = -7.68533e6, .c = -71.1591e6, .d = -135.116e6, .e = 4.74248, .f = 6.00453},
              .form = TransverseForm::b,
              .in_plane = {.modulus = 1.0e9},
              .through = {.modulus = 50e9},
              .density = areal_density / thickness},
          .thickness = thickness,
          .plies = vest_plies,
          .source = "curves, rupture strains, unload strain, shear moduli: Raftenberg 2004, Table 1 [S]; in-plane shear assumed and "
                    "through shear chosen against collapsing elements, both by the paper [S]; which factor of the transverse "
                    "denominator is squared: B is one of two readings of a garbled print [D]; areal density 5.2272 kg/m2 = 1440 kg/m3 "
                    "x 3.63 mm [S], so 29 plies [D] of 0.180 kg/m2 [R-2nd]; 0.23 mm a ply [K2]; density = areal density / thickness",
          .confidence = "S, D, K2"};
}

FabricMaterial kevlar_hooke_wstm() {
  return {.name = "kevlar_hooke_wstm",
          .model = HookeSolid{.young = 74e9, .poisson = 0.2, .density = 1440},
          .thickness = 3.63e-3,
          .plies = vest_plies,
          .source = "modulus, ratio, density, thickness: Raftenberg 2004, section 2, after Johnson, Beissel & Cunniff 1999 [S]; 29 plies [D]",
          .confidence = "S"};
}

const std::vector<FabricMaterial>& library() {
  static const std::vector<FabricMaterial> all = {kevlar_km2_raftenberg(), kevlar_hooke_wstm()};
  return all;
}

} // namespace

const FabricMaterial* find_fabric(std::string_view name) {
  const auto& all = library();
  const auto at = std::find_if(all.begin(), all.end(), [&](const FabricMaterial& m) { return m.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> fabric_names() {
  std::vector<std::string> names;
  for (const FabricMaterial& m : library()) {
    names.push_back(m.name);
  }
  return names;
}

std::string describe(const FabricMaterial& m) {
  const double rho = density(m.model);
  return fmt::format("{}\n  density     {:g} kg/m3, {:g} kg/m2\n  thickness   {:g} m, {} plies\n  fabric      {}\n  source      {}\n  confidence  {}\n",
                     m.name, rho, rho * m.thickness, m.thickness, m.plies, describe(m.model), m.source, m.confidence);
}

} // namespace ballast
