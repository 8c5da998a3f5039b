// The verification cases by family; each adds its own to the list.
#pragma once

#include "problems/verify.hpp"

namespace ballast::verify {

void add_riemann_cases(std::vector<VerifyCase>& cases);

} // namespace ballast::verify
