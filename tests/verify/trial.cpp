#include "tests/verify/trial.hpp"

#include "core/error.hpp"
#include "problems/verify.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

const Trial* trial = nullptr; // of the case that runs now
TrialOutcome outcome;

/// Steps that a run under trial may take: one that goes on for ever has stopped.
template <int Dim> class Patience : public Observer<Dim> {
public:
  bool record(const Scene<Dim>&, const Clock& clock) override { return clock.step < most; }

private:
  static constexpr long most = 200000;
};

double sum_of(const Totals& t) { return t.internal() + t.kinetic_energy; }

/// Energy that no entry of the ledger explains, of its scale.
template <int Dim> double missing_energy(const Scene<Dim>& scene, double before, double after) {
  const Ledger& l = scene.ledger;
  const double known = l.boundary_work + l.ambient_work + l.void_work - l.energy_out - l.sliver_energy - l.remap_kinetic_loss;
  const double scale = std::max(std::abs(before), std::abs(after)) + std::abs(l.boundary_work) + std::abs(l.energy_out);
  return std::abs(after - before - known) / scale;
}

} // namespace

namespace verify {

template <int Dim> bool go(Scene<Dim>& scene, Clock& clock, const std::vector<Observer<Dim>*>& observers) {
  if (trial == nullptr) {
    return run(scene, clock, observers);
  }
  scene.numerics.cfl = trial->cfl;
  scene.numerics.closure = trial->closure;
  for (Block<Dim>& b : scene.blocks) {
    b.motion.remap_every = trial->remap_every;
    b.closure = trial->closure;
    outcome.remapped = outcome.remapped || b.motion.remaps();
    outcome.mixed = outcome.mixed || b.materials.size() > 1;
  }
  ++outcome.runs;
  const double before = sum_of(totals(scene.blocks[0]));
  Patience<Dim> patience;
  std::vector<Observer<Dim>*> all = observers;
  all.push_back(&patience);
  std::string why;
  bool ended = false;
  try {
    ended = run(scene, clock, all);
    why = ended || clock.done() ? "" : "did not end";
  } catch (const std::exception& error) {
    why = error.what();
  }
  outcome.steps += clock.step;
  outcome.floors += scene.ledger.energy_floors;
  outcome.retries += scene.ledger.retries;
  if (!why.empty()) {
    ++outcome.stopped;
    outcome.why = outcome.why.empty() ? why : outcome.why;
  } else {
    const double off = missing_energy(scene, before, sum_of(totals(scene.blocks[0])));
    outcome.unaccounted = std::max(outcome.unaccounted, std::isfinite(off) ? off : 1.0);
  }
  return ended;
}

template bool go<2>(Scene<2>&, Clock&, const std::vector<Observer<2>*>&);
template bool go<3>(Scene<3>&, Clock&, const std::vector<Observer<3>*>&);

} // namespace verify

TrialOutcome run_trial(const VerifyCase& c, const Trial& how) {
  outcome = {};
  trial = &how;
  VerifyReport ignored;
  try {
    c.run(ignored); // what it measures on a run that stopped means nothing
  } catch (const std::exception& error) {
    outcome.why = outcome.why.empty() ? error.what() : outcome.why;
  }
  trial = nullptr;
  return outcome;
}

} // namespace ballast
