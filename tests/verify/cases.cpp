#include "tests/verify/cases.hpp"

namespace ballast {

std::vector<VerifyCase> verification_cases() {
  std::vector<VerifyCase> cases;
  verify::add_riemann_cases(cases);
  verify::add_solid_impact_cases(cases);
  verify::add_advection_cases(cases);
  verify::add_strong_tube_cases(cases);
  verify::add_exact_scene_cases(cases);
  verify::add_remap_interval_cases(cases);
  verify::add_impact_cases(cases);
  verify::add_blast_cases(cases);
  verify::add_noh_cases(cases);
  verify::add_slanted_cases(cases);
  verify::add_vacuum_cases(cases);
  verify::add_triple_point_cases(cases);
  verify::add_deformation_cases(cases);
  verify::add_vibration_cases(cases);
  verify::add_carried_plate_cases(cases);
  verify::add_collapse_cases(cases);
  verify::add_rest_cases(cases);
  verify::add_piston_cases(cases);
  verify::add_frame_cases(cases);
  verify::add_open_boundary_cases(cases);
  verify::add_absorbing_cases(cases);
  verify::add_plate_cases(cases);
  verify::add_spall_cases(cases);
  verify::add_gas_metal_cases(cases);
  verify::add_eos_cases(cases);
  verify::add_shell_cases(cases);
  verify::add_standing_wave_cases(cases);
  verify::add_round_solid_cases(cases);
  verify::add_spinning_disc_cases(cases);
  return cases;
}

} // namespace ballast
