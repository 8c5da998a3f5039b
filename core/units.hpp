// Units of deck quantities: "823 m/s", "0.5 mm", "34.5 MPa". Inside the code everything is SI; only
// this file converts. A bare number is SI already.
#pragma once

#include <string>
#include <string_view>

namespace ballast {

enum class Dimension {
  none,
  length,
  time,
  velocity,
  mass,
  density,
  pressure,
  energy,
  specific_energy,
  temperature,
  angle,
  specific_heat,
  conductivity,
  areal_density,
  rate
};

/// "velocity"
std::string_view name_of(Dimension dimension);
/// The SI unit numbers of this dimension are kept in: "m/s"; empty for none.
std::string_view si_unit(Dimension dimension);
/// All units a quantity may carry: "m/s, km/s, mm/us, ft/s"; empty for none.
std::string allowed_units(Dimension dimension);

/// `problem` is empty when the text was understood; `value` is then in SI.
struct Quantity {
  double value = 0;
  std::string problem;
  bool ok() const { return problem.empty(); }
};

/// Reads "0.5 mm" (or "0.5mm", or "0.5": SI) as a quantity of the given dimension.
Quantity parse_quantity(std::string_view text, Dimension dimension);

} // namespace ballast
