// Small operations on rows that must give the same bits on every instruction set.
#pragma once

#include <cstdint>

namespace ballast {

/// Sum of term(i) for i in [0, n) in eight lanes, added lane by lane: vectorises, and the order does not depend on how.
template <class Term> inline double lane_total(int n, Term term) {
  double lane[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  int i = 0;
  for (; i + 8 <= n; i += 8) {
    for (int l = 0; l < 8; ++l) {
      lane[l] += term(i + l);
    }
  }
  double sum = 0;
  for (; i < n; ++i) {
    sum += term(i);
  }
  for (const double l : lane) {
    sum += l;
  }
  return sum;
}

/// Sum of n values likewise.
inline double lane_sum(const double* x, int n) {
  return lane_total(n, [x](int i) { return x[i]; });
}

/// The material of all `count` cells from `owner` on, or -1 (also where owners say -1: mixed).
inline int sole_owner(const std::int8_t* owner, int count) {
  int others = 0;
  const std::int8_t first = owner[0];
#pragma omp simd reduction(+ : others)
  for (int i = 0; i < count; ++i) {
    others += owner[i] != first ? 1 : 0;
  }
  return others == 0 && first >= 0 ? first : -1;
}

/// owner[i] = q where fraction[i] says that material q fills the cell, for i in [begin, end).
inline void mark_owner(const double* fraction, int q, int begin, int end, std::int8_t* owner) {
  constexpr double pure_enough = 1 - 1e-12; // what a remap's round-off leaves of others
  const int mark = q;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    const int old = owner[i];
    owner[i] = static_cast<std::int8_t>(fraction[i] >= pure_enough ? mark : old);
  }
}

} // namespace ballast
