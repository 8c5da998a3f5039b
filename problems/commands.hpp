// What the program's words do. Each returns the exit status; Error and NumericalFailure pass
// through and main turns them into a message and a status.
#pragma once

#include "problems/exact_solution.hpp"

#include <string>
#include <vector>

namespace ballast {

/// As in CMakeLists.txt; a test compares them.
inline constexpr const char* version = "0.1.0";

struct RunOptions {
  std::string deck;
  std::string out;                   ///< run directory; empty: runs/<deck's name>
  std::vector<std::string> settings; ///< --set key.path=value
  int threads = 0;                   ///< 0: as many as the machine has
  std::string restart;               ///< checkpoint to go on from, empty: start new
  ExactSolver exact = {};            ///< measures the end where the scene's exact solution is known
};

struct VerifyOptions {
  std::vector<std::string> names; ///< empty: all but those too long for every run
  bool all = false;               ///< those, too
  bool hard = false;              ///< every case at several CFL numbers, remap intervals and closures
  bool list = false;              ///< only name the cases
  int threads = 0;
};

struct CheckOptions {
  std::string deck;
  std::vector<std::string> settings;
};

struct StudyOptions {
  std::string deck;
  std::vector<std::string> vary;      ///< "key=v1,v2"
  std::vector<std::string> cases;     ///< "name: deck=FILE; key=value; ...": a first variation of decks and keys together
  std::vector<std::string> settings;  ///< --set, for all
  std::string reference = "finest";   ///< or a deck, or "exact", or the name of a case or a run
  std::string out;                    ///< folder; empty: studies/<deck's name>
  int jobs = 1, threads = 0;          ///< runs at once; threads of each, 0: the machine's shared by the jobs
  ExactSolver exact = {};             ///< what `--reference exact` asks
};

int run_command(const RunOptions& options);
/// `folder`: out, where the tables are.
int study_command(const StudyOptions& options, std::string& folder);
int verify_command(const VerifyOptions& options);
int check_command(const CheckOptions& options);
/// Prints one material or fabric, or all; an unknown name throws Error.
int materials_command(const std::string& name);
/// Prints docs/deck.md.
int deck_reference_command();
/// Prints the table of docs/injury.md.
int injury_reference_command();

} // namespace ballast
