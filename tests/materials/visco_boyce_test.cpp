// Laws of Bergstroem-Boyce networks, against independent integrations (tests/data/bb_*).
#include "visco_points.hpp"

#include "tests/exact/reference_table.hpp"

#include <algorithm>
#include <cstdio>

namespace ballast {
namespace {

struct History {
  const char* file;
  BergstroemBoyce law;
};

std::vector<History> histories() {
  return {{"bb_tissueNH_shear_rate1000", tissue_boyce()},
          {"bb_tissueNH_uniaxial_rate0.01", tissue_boyce()},
          {"bb_tissueNH_uniaxial_rate100000", tissue_boyce()},
          {"bb_elastomer8_shear_rate1", elastomer_boyce()},
          {"bb_elastomer8_uniaxial_rate1", elastomer_boyce()}};
}

/// Largest error of the stress over the largest stress, taking every `stride`-th row of the table as a step.
double history_error(const History& h, const TissueOptions& options, std::size_t stride, double* energy_error = nullptr) {
  const exact::ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/" + h.file + ".csv");
  const bool shear = std::string(h.file).find("shear") != std::string::npos;
  TissueIntegrator integrator(options);
  Points p(h.law, 1);
  Mat before = unit_mat;
  double t = 0, worst = 0, largest = 0, stored = 0, residual = 0, work = 0;
  for (std::size_t r = stride; r < table.row_count(); r += stride) {
    const Mat now = shear ? sheared(table.number(r, "k")) : stretched(table.number(r, "lambda"));
    const double to = table.number(r, "t");
    p.move(0, midpoint_gradient(before, now), to - t);
    EXPECT_FALSE(integrator.advance(h.law, p.row)) << h.file << " " << t;
    EXPECT_GE(p.dissipated[0], 0) << h.file << " " << t;
    before = now;
    t = to;
    residual += p.work[0] - (p.stored[0] - stored) - p.dissipated[0];
    work += std::abs(p.work[0]);
    stored = p.stored[0];
    const Sym s = p.stress_of(0);
    const double got = shear ? s[3] : 1.5 * s[0], expected = table.number(r, shear ? "s12" : "sigma_uniaxial");
    worst = std::max(worst, std::abs(got - expected));
    largest = std::max(largest, std::abs(expected));
    if (shear) {
      worst = std::max({worst, std::abs(s[0] - table.number(r, "dev11")), std::abs(s[2] - table.number(r, "dev33"))});
    }
  }
  if (energy_error) {
    *energy_error = std::abs(residual) / work;
  }
  return worst / largest;
}

TEST(Boyce, Explore) {
  for (const History& h : histories()) {
    for (const std::size_t stride : {1UL, 4UL}) {
      std::printf("%s stride %zu:", h.file, stride);
      double e = 0;
      std::printf(" cvode %.1e", history_error(h, by_path(BranchPath::cvode), stride, &e));
      std::printf(" (%.1e)", e);
      for (const int n : {1, 2, 4, 8}) {
        std::printf(" fast%d %.1e", n, history_error(h, by_path(BranchPath::fixed, n), stride, &e));
        std::printf(" (%.1e)", e);
      }
      std::printf(" mixed %.1e", history_error(h, by_path(BranchPath::mixed), stride, &e));
      std::printf(" (%.1e)\n", e);
    }
  }
}

} // namespace
} // namespace ballast
