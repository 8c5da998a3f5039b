// Temporary: replaced by run.cpp and verify.cpp.
#include "problems/commands.hpp"

#include "core/error.hpp"

namespace ballast {

int run_command(const RunOptions&) {
  throw Error("run is not built into this program yet");
}
int verify_command(const VerifyOptions&) {
  throw Error("verify is not built into this program yet");
}

} // namespace ballast
