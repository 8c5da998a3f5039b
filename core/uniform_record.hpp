// UniformRecord: what a run of unequal steps would have given at equal intervals, 0, h, 2h ..., linear between steps.
// The difference of two neighbours of a velocity over h is the mean acceleration between them, exactly; nothing is lost of it.
#pragma once

#include <span>
#include <vector>

namespace ballast {

class UniformRecord {
public:
  UniformRecord() = default;
  /// `interval` in s.
  UniformRecord(double interval, std::size_t columns) : interval_(interval), last_(columns, 0.0), columns_(columns) {}

  /// Values at time t, later than that of the call before; the first call is at t = 0.
  void add(double t, std::span<const double> values);
  double interval() const { return interval_; }
  std::size_t size() const { return count_; }
  const std::vector<double>& column(std::size_t c) const { return columns_[c]; }
  /// Longest time between two calls, s: what is shorter is not in the record.
  double longest_step() const { return longest_; }

  std::vector<double> memory() const;
  /// The inverse; returns how many numbers it took.
  std::size_t recall(std::span<const double> numbers);

private:
  double interval_ = 0, time_ = 0, longest_ = 0;
  std::size_t count_ = 0;
  std::vector<double> last_;
  std::vector<std::vector<double>> columns_;
};

/// Rates of change from sample to sample, one fewer than samples.
std::vector<double> rates(std::span<const double> samples, double interval);

/// Every `stride`th of them, from the first on.
std::vector<double> every(std::span<const double> samples, std::size_t stride);

} // namespace ballast
