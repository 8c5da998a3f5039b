// CFC filter: the phaseless low pass of crash tests, SAE J211-1 and ISO 6487 (channel frequency classes).
//
// Two poles, Butterworth, once forwards and once backwards over samples an interval T apart:
//   w_d = 2 pi CFC 2.0775,  w_a = tan(w_d T / 2),  q = 1 + sqrt(2) w_a + w_a^2,
//   a0 = a2 = w_a^2 / q,  a1 = 2 a0,  b1 = -2 (w_a^2 - 1) / q,  b2 = (-1 + sqrt(2) w_a - w_a^2) / q,
//   y_k = a0 x_k + a1 x_(k-1) + a2 x_(k-2) + b1 y_(k-1) + b2 y_(k-2).
// Both passes: |H|^2 = 1 / (1 + (tan(pi f T) / w_a)^4), -6 dB at 2.0775 CFC, -3 dB at 5/3 CFC (1650 Hz of CFC 1000), no phase.
//
// The standard leaves the ends open. Here the record is zero before its first sample, as are forces and accelerations before an
// impact, and mirrored at its last. Compromise: what is within 1 / CFC of the end depends on how the record would go on.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace ballast {

inline constexpr std::array<int, 4> cfc_classes = {60, 180, 600, 1000};

/// Longest interval between samples for a class, s: ten samples to 1 / CFC.
double longest_interval(int cfc);

/// Filtered samples, as many as given. `interval` in s. Throws Error where it is too long for the class.
std::vector<double> cfc_filtered(std::span<const double> samples, double interval, int cfc);

} // namespace ballast
