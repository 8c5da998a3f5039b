// Verification: named cases that compare Ballast with exact solutions and laws. The cases and their
// exact solutions live in tests/verify and tests/exact and are linked into the program.
#pragma once

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
};

/// All cases, defined in tests/verify/cases.cpp.
std::vector<VerifyCase> verification_cases();

/// Runs the named cases (all when empty), prints a table; number of failed gates.
int run_verification(const std::vector<std::string>& names);

} // namespace ballast
