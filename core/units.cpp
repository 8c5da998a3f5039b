#include "core/units.hpp"

#include <array>
#include <charconv>
#include <fmt/format.h>
#include <numbers>
#include <vector>

namespace ballast {
namespace {

struct Unit {
  std::string_view name;
  double factor; ///< SI = factor * number + offset
  double offset = 0;
};

struct DimensionUnits {
  std::string_view name;
  std::vector<Unit> units; ///< the SI unit first
};

const DimensionUnits& units_of(Dimension dimension) {
  constexpr double deg = std::numbers::pi / 180;
  static const std::array<DimensionUnits, 15> table = {{
      {"number", {}},
      {"length",
       {{"m", 1},
        {"mm", 1e-3},
        {"cm", 1e-2},
        {"um", 1e-6},
        {"km", 1e3},
        {"in", 0.0254},
        {"ft", 0.3048}}},
      {"time", {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"min", 60}, {"h", 3600}}},
      {"velocity",
       {{"m/s", 1}, {"km/s", 1e3}, {"mm/us", 1e3}, {"cm/us", 1e4}, {"mm/ms", 1}, {"ft/s", 0.3048}}},
      {"mass", {{"kg", 1}, {"g", 1e-3}, {"mg", 1e-6}, {"gr", 64.79891e-6}, {"lb", 0.45359237}}},
      {"density", {{"kg/m3", 1}, {"g/cm3", 1e3}, {"g/cc", 1e3}, {"kg/m^3", 1}, {"g/cm^3", 1e3}}},
      {"pressure",
       {{"Pa", 1},
        {"kPa", 1e3},
        {"MPa", 1e6},
        {"GPa", 1e9},
        {"bar", 1e5},
        {"kbar", 1e8},
        {"Mbar", 1e11},
        {"atm", 101325},
        {"psi", 6894.757293168}}},
      {"energy", {{"J", 1}, {"mJ", 1e-3}, {"kJ", 1e3}, {"MJ", 1e6}, {"erg", 1e-7}}},
      {"specific energy",
       {{"J/kg", 1}, {"kJ/kg", 1e3}, {"MJ/kg", 1e6}, {"J/g", 1e3}, {"kJ/g", 1e6}}},
      {"temperature", {{"K", 1}, {"degC", 1, 273.15}}},
      {"angle", {{"rad", 1}, {"deg", deg}}},
      {"specific heat", {{"J/kg/K", 1}, {"kJ/kg/K", 1e3}, {"J/g/K", 1e3}}},
      {"conductivity", {{"W/m/K", 1}, {"mW/m/K", 1e-3}}},
      {"areal density", {{"kg/m2", 1}, {"g/m2", 1e-3}, {"g/cm2", 10}, {"kg/m^2", 1}, {"lb/ft2", 4.882427636383051}}},
      {"rate", {{"1/s", 1}, {"1/ms", 1e3}, {"1/us", 1e6}}},
  }};
  return table[static_cast<std::size_t>(dimension)];
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Another dimension that knows this unit, for the message: "mm is a length".
std::string where_known(std::string_view unit) {
  for (int d = 1; d <= static_cast<int>(Dimension::rate); ++d) {
    const DimensionUnits& other = units_of(static_cast<Dimension>(d));
    for (const Unit& u : other.units) {
      if (u.name == unit) {
        return fmt::format(" ({} measures {})", unit, other.name);
      }
    }
  }
  return {};
}

} // namespace

std::string_view name_of(Dimension dimension) {
  return units_of(dimension).name;
}

std::string_view si_unit(Dimension dimension) {
  const auto& units = units_of(dimension).units;
  return units.empty() ? std::string_view{} : units.front().name;
}

std::string allowed_units(Dimension dimension) {
  std::string out;
  for (const Unit& u : units_of(dimension).units) {
    out += (out.empty() ? "" : ", ") + std::string(u.name);
  }
  return out;
}

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  const std::string_view t = trimmed(text);
  const std::string_view digits = t.starts_with('+') ? t.substr(1) : t;
  double number = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (status != std::errc{} || digits.starts_with("inf") || digits.starts_with("nan")) {
    return {0, fmt::format("\"{}\" does not start with a number", text)};
  }
  const std::string_view unit =
      trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  if (unit.empty()) {
    return {number, {}};
  }
  for (const Unit& u : units_of(dimension).units) {
    if (u.name == unit) {
      return {number * u.factor + u.offset, {}};
    }
  }
  if (dimension == Dimension::none) {
    return {0, fmt::format("\"{}\" carries a unit, a plain number is wanted", text)};
  }
  return {0,
          fmt::format("\"{}\" is not a unit of {}{}", unit, name_of(dimension), where_known(unit))};
}

} // namespace ballast
