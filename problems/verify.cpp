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

int run_verification(const std::vector<std::string>& names) {
  const std::vector<VerifyCase> all = verification_cases();
  for (const std::string& name : names) {
    if (std::none_of(all.begin(), all.end(), [&](const VerifyCase& c) { return c.name == name; })) {
      std::string known;
      for (const VerifyCase& c : all) {
        known += (known.empty() ? "" : ", ") + c.name;
      }
      throw Error(fmt::format("no verification case '{}'; there are: {}", name, known));
    }
  }
  int passed = 0, failed = 0;
  fmt::print("{:<46} {:>22} {:>12} {:>8} {:>8}\n", "case: quantity", "asked", "got", "cells", "s");
  for (const VerifyCase& c : all) {
    if (!names.empty() && std::find(names.begin(), names.end(), c.name) == names.end()) {
      continue;
    }
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

} // namespace ballast
