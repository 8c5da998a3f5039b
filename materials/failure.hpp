// Johnson-Cook failure: damage grows with plastic strain over a strain to failure.
//
//   D = sum dep / ef,  ef = [D1 + D2 exp(D3 t)] [1 + D4 ln(rate/eps0)] [1 + D5 T*],
// t = (mean stress)/(equivalent stress), tension-positive, not above 1.5; rate >= eps0; T* in [0, 1] as in
// the flow stress (materials/strength). Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31. Above t = 1.5 that paper
// lets ef fall on to a spall strain: here the spall pressure stands for it. Some published sets give ef < 0 in
// tension: it is at least 1e-6. From D = 1 on the material has failed: no deviator, no tension. D goes on with the
// strain of what is broken, up to 2: a remap averages it by mass, and broken with sound matter then counts as broken
// from half of it on instead of healing at once.
#pragma once

#include <string>

namespace ballast {

struct JohnsonCookFailure {
  double D1 = 0, D2 = 0, D3 = 0, D4 = 0, D5 = 0;
  double reference_rate = 1;          ///< eps0, 1/s
  double reference_temperature = 293; ///< of the fit, K
  double melt_temperature = 0, specific_heat = 0; ///< K, J/kg/K; needed by D5 only
  double start_temperature = 293;     ///< of the scene, K
};

struct FailureState {
  double triaxiality = 0;    ///< -p / q, tension-positive
  double rate = 0;           ///< of plastic strain, 1/s
  double thermal_energy = 0; ///< e - e0, J/kg
};

double failure_strain(const JohnsonCookFailure& m, const FailureState& s);

inline constexpr double most_damage = 2;
[[nodiscard]] inline bool has_failed(double damage) { return damage >= 1; }

std::string describe(const JohnsonCookFailure& m);

} // namespace ballast
