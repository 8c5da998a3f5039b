// Verification: named cases that compare Ballast with exact solutions and laws. The cases and their
// exact solutions live in tests/verify and tests/exact and are linked into the program.
#pragma once

#include "ale/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace ballast {

/// One line of the report: what was asked, what was got.
struct VerifyRow {
  std::string quantity;
  std::string asked;
  double got = 0;
  bool passed = true;
  bool gate = true; ///< false: reported only
};

class VerifyReport {
public:
  /// got <= limit
  void at_most(const std::string& quantity, double limit, double got);
  void at_least(const std::string& quantity, double limit, double got);
  /// low <= got <= high
  void between(const std::string& quantity, double low, double high, double got);
  /// |got / want - 1| <= relative
  void close(const std::string& quantity, double want, double relative, double got);
  void note(const std::string& quantity, double got);

  void set_cells(long cells) { cells_ = cells; }
  long cells() const { return cells_; }
  const std::vector<VerifyRow>& rows() const { return rows_; }

private:
  long cells_ = 0;
  std::vector<VerifyRow> rows_;
};

struct VerifyCase {
  std::string name;
  std::string law; ///< one line: what it checks
  std::function<void(VerifyReport&)> run;
  bool by_name = false; ///< too long for every run: only when named, or with `--all`
};

/// All cases, defined in tests/verify/cases.cpp.
std::vector<VerifyCase> verification_cases();

/// How `verify --hard` runs every case, whatever the case itself chose.
struct Trial {
  double cfl = 0.5;
  int remap_every = 1; ///< of what is remapped
  Closure closure = Closure::pressure_relaxation;
};

/// What became of the runs of a case.
struct TrialOutcome {
  int runs = 0, stopped = 0;
  std::string why;                         ///< the first that stopped
  long steps = 0, floors = 0, retries = 0; ///< floors: cut energy returns
  double unaccounted = 0;                  ///< energy, worst, of its scale
  bool remapped = false, mixed = false;    ///< do remap_every, closure matter?
};
/// Runs a case under a trial; tests/verify/trial.cpp.
TrialOutcome run_trial(const VerifyCase& c, const Trial& trial);

/// Runs the named cases (none named: those that every run has, or `all`), prints a table; number of failed gates.
int run_verification(const std::vector<std::string>& names, bool all);

/// Every case chosen as above at CFL 0.3, 0.5, 0.8, remapped every step and every fourth, with every closure, as far as it has a remap and mixed
/// cells: a table of what ended, what stopped and why, floors, energy unaccounted. Number of runs that stopped.
int run_hard_verification(const std::vector<std::string>& names, bool all);

} // namespace ballast
