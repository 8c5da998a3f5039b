// Error: what a user of Ballast is told when set-up or a run cannot go on.
// Set-up code throws it; kernels never throw (they reduce the worst cell and the step reports it).
#pragma once

#include <stdexcept>
#include <string>

namespace ballast {

/// Exit statuses of the `ballast` program; part of the contract in docs/architecture.md.
enum class ExitStatus { finished = 0, bad_input = 2, numerical_failure = 3, interrupted = 130 };

/// Bad input: a deck, a command line or a file that cannot be used. The message names the place and the cure.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A run that has to stop: the message names block, cell, material and quantity.
class NumericalFailure : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace ballast
