// The verification cases by family; each adds its own to the list.
#pragma once

#include "problems/verify.hpp"

namespace ballast::verify {

void add_riemann_cases(std::vector<VerifyCase>& cases);
void add_solid_impact_cases(std::vector<VerifyCase>& cases);
void add_advection_cases(std::vector<VerifyCase>& cases);
void add_strong_tube_cases(std::vector<VerifyCase>& cases);
void add_exact_scene_cases(std::vector<VerifyCase>& cases);
void add_remap_interval_cases(std::vector<VerifyCase>& cases);
void add_impact_cases(std::vector<VerifyCase>& cases);
void add_blast_cases(std::vector<VerifyCase>& cases);
void add_noh_cases(std::vector<VerifyCase>& cases);
void add_slanted_cases(std::vector<VerifyCase>& cases);
void add_vacuum_cases(std::vector<VerifyCase>& cases);
void add_triple_point_cases(std::vector<VerifyCase>& cases);
void add_deformation_cases(std::vector<VerifyCase>& cases);
void add_vibration_cases(std::vector<VerifyCase>& cases);
void add_collapse_cases(std::vector<VerifyCase>& cases);
void add_carried_plate_cases(std::vector<VerifyCase>& cases);
void add_rest_cases(std::vector<VerifyCase>& cases);
void add_piston_cases(std::vector<VerifyCase>& cases);
void add_frame_cases(std::vector<VerifyCase>& cases);
void add_open_boundary_cases(std::vector<VerifyCase>& cases);
void add_absorbing_cases(std::vector<VerifyCase>& cases);
void add_plate_cases(std::vector<VerifyCase>& cases);
void add_spall_cases(std::vector<VerifyCase>& cases);
void add_gas_metal_cases(std::vector<VerifyCase>& cases);
void add_eos_cases(std::vector<VerifyCase>& cases);
void add_shell_cases(std::vector<VerifyCase>& cases);
void add_standing_wave_cases(std::vector<VerifyCase>& cases);
void add_round_solid_cases(std::vector<VerifyCase>& cases);
void add_spinning_disc_cases(std::vector<VerifyCase>& cases);

} // namespace ballast::verify
