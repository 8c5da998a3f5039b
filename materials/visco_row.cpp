#include "materials/visco_row.hpp"

namespace ballast {

void append_tensor_names(std::vector<std::string>& names, const std::string& stem) {
  for (const char* component : {"xx", "yy", "zz", "xy", "yz", "zx"}) {
    names.push_back(stem + "_" + component);
  }
}

} // namespace ballast
