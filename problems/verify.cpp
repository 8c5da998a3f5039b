#include "problems/verify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballast {

void VerifyReport::at_most(const std::string& q, double limit, double got) {
  rows_.push_back({q, fmt::format("<= {:.4g}", limit), got, got <= limit, true});
}

void VerifyReport::at_least(const std::string& q, double limit, double got) {
  rows_.push_back({q, fmt::format(">= {:.4g}", limit), got, got >= limit, true});
}

void VerifyReport::between(const std::string& q, double low, double high, double got) {
  rows_.push_back({q, fmt::format("{:.5g} .. {:.5g}", low, high), got, got >= low && got <= high, true});
}

void VerifyReport::close(const std::string& q, double want, double relative, double got) {
  rows_.push_back({q, fmt::format("{:.6g} +- {:.3g} %", want, 100 * relative), got,
                   std::abs(got - want) <= relative * std::abs(want), true});
}

void VerifyReport::note(const std::string& q, double got) { rows_.push_back({q, "reported", got, true, false}); }

namespace {

/// The named cases; if none is named those that every run has, or `all`. Throws Error.
std::vector<VerifyCase> chosen_cases(const std::vector<std::string>& names, bool all) {
  std::vector<VerifyCase> cases = verification_cases();
  for (const std::string& name : names) {
    if (std::none_of(cases.begin(), cases.end(), [&](const VerifyCase& c) { return c.name == name; })) {
      std::string known;
      for (const VerifyCase& c : cases) {
        known += (known.empty() ? "" : ", ") + c.name;
      }
      throw Error(fmt::format("no verification case '{}'; there are: {}", name, known));
    }
  }
  std::erase_if(cases, [&](const VerifyCase& c) {
    return names.empty() ? c.by_name && !all : std::find(names.begin(), names.end(), c.name) == names.end();
  });
  return cases;
}

} // namespace

int run_verification(const std::vector<std::string>& names, bool all) {
  int passed = 0, failed = 0;
  fmt::print("{:<46} {:>22} {:>12} {:>8} {:>8}\n", "case: quantity", "asked", "got", "cells", "s");
  for (const VerifyCase& c : chosen_cases(names, all)) {
    VerifyReport report;
    const auto start = std::chrono::steady_clock::now();
    try {
      c.run(report);
    } catch (const std::exception& error) {
      fmt::print("{}: stopped: {}\n", c.name, error.what());
      ++failed;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{} ({})\n", c.name, c.law);
    for (const VerifyRow& row : report.rows()) {
      fmt::print("{} {:<43} {:>22} {:>12.5g} {:>8} {:>8.2f}\n", row.passed ? " " : "!", "  " + row.quantity,
                 row.asked, row.got, report.cells(), seconds);
      if (row.gate) {
        ++(row.passed ? passed : failed);
      }
    }
  }
  fmt::print("{} passed, {} failed\n", passed, failed);
  return failed;
}

int run_hard_verification(const std::vector<std::string>& names, bool all) {
  constexpr double cfls[] = {0.3, 0.5, 0.8};
  constexpr int every[] = {1, 4};
  constexpr Closure closures[] = {Closure::pressure_relaxation, Closure::tipton, Closure::equal_strain};
  const char* const closure_names[] = {"relaxation", "tipton", "equal strain"};
  int stopped = 0, runs = 0;
  fmt::print("{:<24} {:>4} {:>5} {:<12} {:>9} {:>8} {:>7} {:>8} {:>12}  {}\n", "case", "cfl", "remap", "closure", "ended", "steps", "floors", "retries",
             "unaccounted", "stopped by");
  for (const VerifyCase& c : chosen_cases(names, all)) {
    bool remapped = true, mixed = true;
    for (const double cfl : cfls) {
      for (const int n : every) {
        for (const Closure closure : closures) {
          if ((n != every[0] && !remapped) || (closure != closures[0] && !mixed)) {
            continue; // the same run again
          }
          const TrialOutcome o = run_trial(c, {cfl, n, closure});
          if (o.runs == 0) {
            remapped = mixed = false; // no scene is run in it
            continue;
          }
          remapped = o.remapped;
          mixed = o.mixed;
          stopped += o.stopped;
          runs += o.runs;
          fmt::print("{:<24} {:>4} {:>5} {:<12} {:>9} {:>8} {:>7} {:>8} {:>12.3g}  {}\n", c.name, cfl, o.remapped ? fmt::format("{}", n) : "-",
                     o.mixed ? closure_names[static_cast<int>(closure)] : "-", fmt::format("{} of {}", o.runs - o.stopped, o.runs), o.steps, o.floors, o.retries,
                     o.unaccounted, o.why);
          std::fflush(stdout);
        }
      }
    }
  }
  fmt::print("{} of {} runs ended\n", runs - stopped, runs);
  return stopped;
}

} // namespace ballast
