// Fabric: second Piola-Kirchhoff stress S (Pa) from Green strain E, in axes 1 warp, 2 fill, 3 through the thickness.
//
// Raftenberg (Army Science Conference 2004) decouples the components. With N = aE + bE^2 + cE^3 + dE^4, q = 1 + eE + fE^2:
//   warp, fill    S = 0 for E < 0;  N/q to E_rupture;  N/q(E_rupture) (1 - (E - E_rupture)/dE_unload) down to 0, then lost
//   transverse    S = N/((1+2E) q), one factor of it squared (docs/materials.md), for -1/2 < E <= 0;  0 in tension
//   shear         S = 2 G E
// As printed the law is elastic up to E_rupture + dE_unload: the ramp is climbed again on the way back. Known flaws: the ramp
// takes 2.4 to 3.4 times the energy of the curve before it; in-plane compression costs nothing; the transverse stiffness
// grows without bound. Options, all off by default, mend them; off, they change no bit.
// Components stand in the order 11, 22, 33, 12, 23, 13; E12 is half the engineering shear. Tension-positive.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace ballast {

/// N(E)/q(E) of the header; a to d in Pa.
struct RationalFit {
  double a = 0, b = 0, c = 0, d = 0;
  double e = 0, f = 0;
};

/// The yarns of one direction.
struct YarnFamily {
  RationalFit fit;
  double rupture = 0;  ///< Green strain of the largest load
  double unload = 0.4; ///< further strain over which the stress falls to zero; a shorter ramp is an option [S: 0.4]
};

/// Which factor of the transverse denominator is squared: none, 1 + 2E, q. The paper's print is garbled.
enum class TransverseForm { a, b, c };

/// S = G times engineering shear; beyond the angles (engineering shear, rad) its slope is `stiffer`, then `stiffest`.
struct ShearLaw {
  double modulus = 0; ///< Pa
  double stiffer = 0, stiffest = 0;
  double first_angle = std::numeric_limits<double>::infinity();
  double second_angle = std::numeric_limits<double>::infinity();
};

/// Locking shear of Kevlar cloth: 4.14 MPa, 41.4 MPa from 0.25 rad, 345 MPa from 0.35 rad (AWG card, MAT_DRY_FABRIC [R-2nd]).
ShearLaw awg_shear();

/// Once pressed to the density of the solid fabric is a solid: pressure p = K (rho/rho_solid - 1) in all directions,
/// S = -p J C^-1, and the transverse law goes on along its tangent at that density instead of to its pole.
struct SolidHandOver {
  double density = 1440;     ///< kg/m3, solid Kevlar [S]
  double bulk_modulus = 8e9; ///< Pa, of the order of solid polymers (nylon 7.5 GPa [K1]) [K3]
};

/// Yarn stress times 1 + C ln(max(rate/reference, 1)), rate that of extension (1/s): unloading sees 1, so it loses energy.
/// The slope with rate is infinite at the reference: give a smoothed rate.
struct RateFactor {
  double C = 0.02;           ///< one code's guess [R-2nd]; KM2 fibre gains a few % to 20 % up to 1000 /s [K2]
  double reference_rate = 1; ///< 1/s [K3]
};

/// Raftenberg's law and its options.
struct RaftenbergFabric {
  YarnFamily warp, fill;
  RationalFit transverse;
  TransverseForm form = TransverseForm::b;
  ShearLaw in_plane, through; ///< 12; 23 and 13
  double density = 1;         ///< initial, kg/m3
  std::optional<SolidHandOver> solid = {};
  bool secant_unloading = false; ///< past E_rupture: back along the secant to the origin where that lies below the curve
  std::optional<RateFactor> rate = {};
  /// kappa, Pa: warp and fill stretched together stiffen each other. Energy kappa g(E11) g(E22), g' = E (1 - E/E_rupture)
  /// in (0, E_rupture), else 0: the lowest polynomial that leaves the uniaxial fits and stays continuous. No data [K3].
  double coupling = 0;
};

/// Isotropic St Venant-Kirchhoff, S = lambda tr(E) I + 2 mu E: the vest of the paper's section 2. Never lost.
/// Known flaw: collapses when pressed below 0.577 of a length.
struct HookeSolid {
  double young = 0;   ///< Pa
  double poisson = 0;
  double density = 1; ///< kg/m3
};

using FabricModel = std::variant<RaftenbergFabric, HookeSolid>;

using FabricTensor = std::array<double, 6>; ///< 11, 22, 33, 12, 23, 13

/// What an element remembers: the largest Green strain of warp and fill so far, at least 0.
/// A family is lost from E_rupture + dE_unload on; as this only grows, it never heals.
struct FabricState {
  std::array<double, 2> largest = {0, 0};
};

struct FabricStress {
  FabricTensor stress = {};  ///< Pa
  FabricTensor tangent = {}; ///< dS/dE of 11, 22, 33; dS/d(2E), a shear modulus, of 12, 23, 13
  /// rho0 c^2 (Pa) of the fastest wave along 1, 2, 3, c in lengths at rest: an element of rest lengths h is stable for
  /// dt < min h_k / sqrt(wave_modulus_k / rho0). Exact without shear strain and solid, else an upper bound.
  /// It is (1 + 2E) tangent + S, largest over the polarisations; of a rate factor the slope with rate is not in it.
  std::array<double, 3> wave_modulus = {};
};

[[nodiscard]] inline bool is_lost(const YarnFamily& family, double largest) {
  return largest >= family.rupture + family.unload;
}

/// Both families lost: the element leaves the mesh.
[[nodiscard]] bool is_eroded(const RaftenbergFabric& law, const FabricState& state);
[[nodiscard]] inline bool is_eroded(const HookeSolid&, const FabricState&) { return false; }

/// Stress at Green strain E; state.largest grows with it. extension_rate: dE/dt of warp and fill, used by `rate` only.
/// E33 = -1/2 (no thickness) gives an infinite stress: the caller stops or erodes the element before.
[[nodiscard]] FabricStress evaluate(const RaftenbergFabric& law,
                                    const FabricTensor& strain,
                                    FabricState& state,
                                    const std::array<double, 2>& extension_rate = {});
[[nodiscard]] FabricStress evaluate(const HookeSolid& law, const FabricTensor& strain, FabricState& state,
                                    const std::array<double, 2>& extension_rate = {});

/// Elements side by side: arrays of `count` for each component. Null extension_rate: at rest.
struct FabricRows {
  int count = 0;
  std::array<const double*, 6> strain = {};
  std::array<const double*, 2> extension_rate = {};
  std::array<double*, 2> largest = {};      ///< FabricState, updated
  std::array<double*, 6> stress = {};       ///< out
  std::array<double*, 3> wave_modulus = {}; ///< out
};

/// The same bits as the scalar calls, the law chosen once. Cost: docs/materials.md.
void evaluate(const FabricModel& model, const FabricRows& rows);

/// Strain energy (J/m3 at rest) of one family along the printed curve, W' = S. Quadrature, good to 1e-13: for tests and books.
double strain_energy(const YarnFamily& family, double strain);

/// Strain energy (J/m3 at rest) of the whole law as a function of strain alone: elastic options in it, `rate`,
/// `secant_unloading` and loss not.
double strain_energy(const RaftenbergFabric& law, const FabricTensor& strain);
double strain_energy(const HookeSolid& law, const FabricTensor& strain);

/// Throws Error where the constants are not those of a fabric: "where" (a deck's place or a name), the constant, the cure.
void check(const FabricModel& model, std::string_view where);

double density(const FabricModel& model);
std::string describe(const FabricModel& model);

} // namespace ballast
