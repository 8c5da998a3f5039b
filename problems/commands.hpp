// What the program's words do. Each returns the exit status; Error and NumericalFailure pass
// through and main turns them into a message and a status.
#pragma once

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
};

struct VerifyOptions {
  std::vector<std::string> names; ///< empty: all
  bool hard = false;              ///< the slow cases too
  bool list = false;              ///< only name the cases
  int threads = 0;
};

struct CheckOptions {
  std::string deck;
  std::vector<std::string> settings;
};

int run_command(const RunOptions& options);
int verify_command(const VerifyOptions& options);
int check_command(const CheckOptions& options);
/// Prints one material, or all; an unknown name throws Error.
int materials_command(const std::string& name);
/// Prints docs/deck.md.
int deck_reference_command();

} // namespace ballast
