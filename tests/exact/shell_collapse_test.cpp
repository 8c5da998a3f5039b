#include "tests/exact/shell_collapse.hpp"

#include "tests/exact/reference_table.hpp"

#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

TEST(ExactShell, MatchesTabulatedStoppingRadii) {
  const ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/shell_collapse_beryllium.csv");
  ASSERT_GE(table.row_count(), 16u);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Shell shell;
    shell.sphere = table.text(row, "shell") == "sph";
    const double speed = table.number(row, "V0"), inner = stopping_radius(shell, speed);
    // Twelve digits in the table, Simpson's rule with 2000 parts.
    EXPECT_NEAR(inner, table.number(row, "Rf"), 1e-11);
    EXPECT_NEAR(outer_radius(shell, inner), table.number(row, "Sf"), 1e-11);
    shell.shear_modulus = 151.9e9;
    EXPECT_NEAR(stopping_radius(shell, speed), table.number(row, "Rf_elastic"), 1e-9); // a kink in the integrand
  }
}

TEST(ExactShell, WithoutSpeedStaysAndFasterGoesFurther) {
  EXPECT_NEAR(stopping_radius({}, 0), 0.08, 1e-12);
  double before = 0.08;
  for (int speed = 100; speed <= 600; speed += 100) {
    const double r = stopping_radius({}, speed);
    EXPECT_LT(r, before);
    before = r;
  }
}

} // namespace
} // namespace ballast::exact
