#pragma once

#include "tests/exact/riemann.hpp"

#include <array>

/// The named Riemann problems of tests/data/riemann_star_states.csv, as the `#` lines of the
/// reference profiles give them (sg_underwater_explosion_shyue has none: Shyue, J. Comput. Phys.
/// 142 (1998) 208, recalled, and confirmed by the tabulated star state).

namespace ballast::exact {

struct RiemannCase {
  const char* name; ///< row of riemann_star_states.csv
  GasState left;
  GasState right;
  double interface_position;
  double time;
};

/// Units: those of each case (dimensionless, or SI for sg_*).
inline const std::array<RiemannCase, 18> riemann_cases{{
    {"riemann_sod_t0.2", {1, 0, 1, 1.4}, {0.125, 0, 0.1, 1.4}, 0.5, 0.2},
    {"riemann_123_einfeldt", {1, -2, 0.4, 1.4}, {1, 2, 0.4, 1.4}, 0.5, 0.15},
    {"riemann_modified_sod_two_gamma", {1, 0, 2, 2}, {0.125, 0, 0.1, 1.4}, 0.5, 0.2},
    {"riemann_lax", {0.445, 0.698, 3.528, 1.4}, {0.5, 0, 0.571, 1.4}, 0.5, 0.15},
    {"riemann_stationary_contact",
     {1, -19.59745, 1000, 1.4},
     {1, -19.59745, 0.01, 1.4},
     0.8,
     0.012},
    {"riemann_shock_contact_shock", {1, 0.5, 1, 1.4}, {1.25, -0.5, 1, 1.4}, 0.5, 0.3},
    {"riemann_leblanc_exactpack",
     {1, 0, 0.2 / 3, 5.0 / 3},
     {0.01, 0, 2e-10 / 3, 5.0 / 3},
     0.3,
     0.5},
    {"riemann_leblanc_standard",
     {1, 0, 0.2 / 3, 5.0 / 3},
     {0.001, 0, 2e-10 / 3, 5.0 / 3},
     3.0,
     6.0},
    {"riemann_toro3_strong", {1, 0, 1000, 1.4}, {1, 0, 0.01, 1.4}, 0.5, 0.012},
    {"riemann_toro4_strong", {1, 0, 0.01, 1.4}, {1, 0, 100, 1.4}, 0.5, 0.035},
    {"sg_water_air_rho50", {1000, 0, 1e9, 4.4, 6e8}, {50, 0, 1e5, 1.4}, 0.7, 240e-6},
    {"sg_water_air_rho50_229us", {1000, 0, 1e9, 4.4, 6e8}, {50, 0, 1e5, 1.4}, 0.7, 229e-6},
    {"sg_water_air_rho1", {1000, 0, 1e9, 4.4, 6e8}, {1, 0, 1e5, 1.4}, 0.7, 240e-6},
    {"sg_underwater_explosion_shyue",
     {1.241, 0, 2.753, 1.4},
     {0.991, 0, 3.059e-4, 5.5, 1.505},
     0.5,
     0.1},
    {"sg_water_water_impact", {1000, 200, 1e5, 4.4, 6e8}, {1000, -200, 1e5, 4.4, 6e8}, 0.5, 1e-4},
    {"sg_water_cavitation_free", {1000, -20, 1e7, 4.4, 6e8}, {1000, 20, 1e7, 4.4, 6e8}, 0.5, 2e-4},
    {"sg_copper_like_into_water", {8900, 370, 1e5, 4, 34.2e9}, {1000, 0, 1e5, 4.4, 6e8}, 0.0, 5e-5},
    {"sg_contact_advect", {1000, 100, 1e5, 4.4, 6e8}, {1, 100, 1e5, 1.4}, 0.3, 2e-3},
}};

} // namespace ballast::exact
