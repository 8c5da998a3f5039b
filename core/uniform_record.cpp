#include "core/uniform_record.hpp"

#include <algorithm>

namespace ballast {

void UniformRecord::add(double t, std::span<const double> values) {
  if (count_ > 0) {
    longest_ = std::max(longest_, t - time_);
  }
  for (double at = interval_ * static_cast<double>(count_); at <= t; at = interval_ * static_cast<double>(++count_)) {
    const double part = t > time_ ? (at - time_) / (t - time_) : 1.0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      columns_[c].push_back(last_[c] + part * (values[c] - last_[c]));
    }
  }
  time_ = t;
  last_.assign(values.begin(), values.end());
}

std::vector<double> UniformRecord::memory() const {
  std::vector<double> numbers = {time_, longest_, static_cast<double>(count_)};
  numbers.insert(numbers.end(), last_.begin(), last_.end());
  for (const std::vector<double>& column : columns_) {
    numbers.insert(numbers.end(), column.begin(), column.end());
  }
  return numbers;
}

std::size_t UniformRecord::recall(std::span<const double> numbers) {
  time_ = numbers[0];
  longest_ = numbers[1];
  count_ = static_cast<std::size_t>(numbers[2]);
  std::size_t at = 3;
  const auto take = [&](std::size_t count) {
    at += count;
    return numbers.subspan(at - count, count);
  };
  const auto last = take(columns_.size());
  last_.assign(last.begin(), last.end());
  for (std::vector<double>& column : columns_) {
    const auto values = take(count_);
    column.assign(values.begin(), values.end());
  }
  return at;
}

std::vector<double> rates(std::span<const double> samples, double interval) {
  std::vector<double> out;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    out.push_back((samples[k] - samples[k - 1]) / interval);
  }
  return out;
}

std::vector<double> every(std::span<const double> samples, std::size_t stride) {
  std::vector<double> out;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    out.push_back(samples[k]);
  }
  return out;
}

} // namespace ballast
