// Floating point traps: a debug build stops at the operation that makes the first NaN or infinity.
#pragma once

namespace ballast {

/// In builds without NDEBUG: division by zero, invalid operations and overflow raise SIGFPE, in this
/// thread and in those it starts from now on. Release does nothing: it compiles without trapping
/// maths, where selects may compute the side they drop.
void trap_floating_point_errors();

} // namespace ballast
