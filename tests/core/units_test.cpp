#include "core/units.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

double si(const char* text, Dimension d) {
  const Quantity q = parse_quantity(text, d);
  EXPECT_TRUE(q.ok()) << q.problem;
  return q.value;
}

TEST(Units, ConvertToSi) {
  EXPECT_DOUBLE_EQ(si("823 m/s", Dimension::velocity), 823);
  EXPECT_DOUBLE_EQ(si("0.5 mm", Dimension::length), 0.5e-3);
  EXPECT_DOUBLE_EQ(si("0.25mm", Dimension::length), 0.25e-3);
  EXPECT_DOUBLE_EQ(si("34.5 MPa", Dimension::pressure), 34.5e6);
  EXPECT_DOUBLE_EQ(si("147 gr", Dimension::mass), 147 * 64.79891e-6); // 9.525 g
  EXPECT_DOUBLE_EQ(si("200 us", Dimension::time), 200e-6);
  EXPECT_DOUBLE_EQ(si("1 atm", Dimension::pressure), 101325);
  EXPECT_DOUBLE_EQ(si("20 degC", Dimension::temperature), 293.15);
  EXPECT_DOUBLE_EQ(si("180 deg", Dimension::angle), 3.141592653589793);
  EXPECT_DOUBLE_EQ(si("-1.5e-3 m", Dimension::length), -1.5e-3);
}

TEST(Units, BareNumbersAreSi) {
  EXPECT_DOUBLE_EQ(si("12.5", Dimension::density), 12.5);
  EXPECT_DOUBLE_EQ(si("0.5", Dimension::none), 0.5);
}

TEST(Units, WrongUnitSaysWhatItMeasures) {
  const Quantity q = parse_quantity("20 mm", Dimension::time);
  EXPECT_FALSE(q.ok());
  EXPECT_NE(q.problem.find("mm measures length"), std::string::npos) << q.problem;
  EXPECT_EQ(allowed_units(Dimension::time), "s, ms, us, ns, min, h");
}

TEST(Units, RefuseWhatIsNoQuantity) {
  for (const char* text : {"", "fast", "mm", "nan", "inf", "1 2", "--1 m"}) {
    EXPECT_FALSE(parse_quantity(text, Dimension::length).ok()) << text;
  }
  EXPECT_FALSE(parse_quantity("3 mm", Dimension::none).ok());
}

} // namespace
} // namespace ballast
