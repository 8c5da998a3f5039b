// Mesh lines at equal distances.
#pragma once

#include <vector>

namespace ballast {

inline std::vector<double> uniform(double from, double to, int cells) {
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i) {
    x.push_back(from + (to - from) * i / cells);
  }
  return x;
}

} // namespace ballast
