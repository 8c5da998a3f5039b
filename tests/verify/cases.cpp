#include "tests/verify/cases.hpp"

namespace ballast {

std::vector<VerifyCase> verification_cases() {
  std::vector<VerifyCase> cases;
  verify::add_riemann_cases(cases);
  return cases;
}

} // namespace ballast
