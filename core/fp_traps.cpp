#include "core/fp_traps.hpp"

#include <cfenv>

namespace ballast {

void trap_floating_point_errors() {
#ifndef NDEBUG
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); // glibc
#endif
}

} // namespace ballast
