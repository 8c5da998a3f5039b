// Scene: the blocks of a run, the choices of method and what the run keeps account of.
#pragma once

#include "ale/block.hpp"
#include "ale/layers/layers.hpp"
#include "ale/step_undo.hpp"
#include "core/threads.hpp"
#include "materials/visco_integrator.hpp"
#include "remap/normal.hpp"

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ballast {

struct Numerics {
  double cfl = 0.5;
  Closure closure = Closure::pressure_relaxation;
  double quadratic_q = 1.0; ///< on Kuropatenko's (gamma + 1)/4 taken as 2/3, see ale/viscosity
  double linear_q = 0.5;    ///< on the sound speed
  double hourglass = 0.06; ///< of rho c V / L; 64 times it over the CFL number damps a 3D mode
  double shear_q = 0;  ///< 0 to 1: part of q's coefficient that resists shear, too (ale/shear_viscosity)
  double subzonal_pressure = 0; ///< merit factor, 0 to 1; 2D Lagrangian blocks (ale/subzonal_pressure)
  bool energy_return = true; ///< kinetic energy lost in the remap goes to internal energy
  remap::NormalMethod normal = remap::NormalMethod::elvira;
  double dt_initial = 0; ///< s, 0: a tenth of the stable step
  double dt_growth = 1.1;
  double dt_max = std::numeric_limits<double>::infinity();
  double dt_min = 0; ///< s: a stable step below it is a failure
  double max_volume_change = 0.2; ///< of a cell in one step
  bool spall = true;
  bool sleeping = true; ///< what rests is passed over: the same bits, faster (ale/rest)
  TissueOptions tissue{}; ///< how viscoelastic branches are integrated
};

/// What decided the time step.
enum class DtCause { sound, viscosity, volume_change, growth, maximum, end, retry };
std::string name_of(DtCause cause);

struct DtLimit {
  double dt = std::numeric_limits<double>::infinity();
  int block = 0;
  std::array<int, 3> cell = {-1, -1, -1};
  int material = -1;
  DtCause cause = DtCause::maximum;
};

struct Clock {
  double time = 0, end_time = 0, dt = 0;
  long step = 0;
  DtLimit limit;
  std::array<long, 7> census{}; ///< steps by DtCause

  bool done() const { return time >= end_time; }
  void choose(const DtLimit& stable, const Numerics& numerics);
  void advance();
};

/// Of a viscoelastic material since the start, J: work of its deviator, what of it became heat, and free energy that a remap
/// (a mixture holds less than its parts; Fung's may hold more, then it counts as negative), an interface (ale/traction) or a sliver
/// took. What is stored is the free energy's sum.
struct TissueEnergy {
  double work = 0, dissipated = 0, lost = 0;
  double floored = 0; ///< J of the work that no force has done: heat of Fung branches raised to 0 in steps that are too stiff for them
};
inline void add(TissueEnergy& to, const TissueEnergy& more) {
  to.work += more.work;
  to.dissipated += more.dissipated;
  to.lost += more.lost;
  to.floored += more.floored;
}

/// Energy and mass that left or entered by a named door; all zero in a closed Lagrangian gas run.
struct Ledger {
  double boundary_work = 0;       ///< J, done on the block by moving walls and inflows
  double ambient_work = 0;        ///< J, by the reference pressure on the changing volume
  double void_work = 0;           ///< J gained by cells with void beyond their forces' work: void holds no energy
  double remap_kinetic_loss = 0;  ///< J of kinetic energy lost in remaps and not returned
  double remap_kinetic_return = 0; ///< J lost and returned to internal energy
  double sliding_impact = 0;       ///< J, part of those two: lost where what slides meets the rest or sticks to it
  double energy_out = 0;          ///< J, total energy that crossed open boundaries
  std::vector<double> mass_out;   ///< kg by material
  std::array<double, 3> momentum_out = {0, 0, 0}; ///< kg m/s through open boundaries
  double sliver_energy = 0;       ///< J moved or dropped with slivers
  double sliver_mass = 0;         ///< kg
  long slivers = 0;
  long spalled_cells = 0;
  long closed_voids = 0;          ///< voids closed after remaps: residues, and what compressed materials fill
  long energy_floors = 0;         ///< cells whose energy return was cut to keep e from falling
  long retries = 0;
  double embedded_given = 0;      ///< J that blocks gave to layers inside them; what of it did not reach them (load_work) is the loss of impacts
  std::vector<TissueEnergy> tissue; ///< by material; empty without a viscoelastic one
  TissueCounts tissue_counts{};
  long tissue_repairs = 0; ///< states that a remap left not positive definite, drawn to rest
};

template <int Dim> struct Embedding; // ale/embedding.hpp

template <int Dim> struct Scene {
  std::string title;
  std::vector<Block<Dim>> blocks;
  std::vector<Layers<Dim>> layers; ///< stacks of fabric, from the lowest
  std::vector<std::shared_ptr<Embedding<Dim>>> embedded; ///< of the blocks that they lie in
  Numerics numerics;
  Ledger ledger;
  std::vector<TissueIntegrator> tissue; ///< one a thread
  std::unique_ptr<ThreadPool> pool = std::make_unique<ThreadPool>(1);
  std::vector<StepUndo> undo; ///< by block, of the step at hand; empty unless tissue is integrated
};

} // namespace ballast
