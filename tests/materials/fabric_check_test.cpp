// Constants that are no fabric's are refused: which one, and the cure.
#include "core/error.hpp"
#include "tests/materials/fabric_laws.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

using fabric_laws::paper;

std::string complaint(const FabricModel& model) {
  try {
    check(model, "materials.vest");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const FabricModel& model, const std::string& place, const std::string& cure) {
  const std::string said = complaint(model);
  EXPECT_EQ(said.rfind("materials.vest: " + place, 0), 0U) << place << " / " << said;
  EXPECT_NE(said.find(cure), std::string::npos) << said;
}

template <class Change> RaftenbergFabric with(Change change) {
  RaftenbergFabric law = paper();
  change(law);
  return law;
}

TEST(FabricCheck, AcceptsEveryLawOfTheTests) {
  for (const auto& named : fabric_laws::elastic_laws()) {
    EXPECT_EQ(complaint(named.model), "") << named.name;
  }
}

TEST(FabricCheck, NamesThePoleOfAFit) {
  expect_refused(with([](auto& m) { m.warp.fit.f = 100; }), "warp has a pole", "at E = 0.110"); // vertex 22.0527/200
  expect_refused(with([](auto& m) { m.fill.fit.e = -100; }), "fill has a pole", "keep all printed digits");
  expect_refused(with([](auto& m) { m.transverse.f = 5.5; }), "transverse has a pole", "within [-0.5, 0]");
}

TEST(FabricCheck, RoundedConstantsOfTheTransverseFitAreCaught) { // q of 0.0636 at its least: two digits of e and f are not enough
  EXPECT_EQ(complaint(with([](auto& m) { m.transverse.e = 4.742, m.transverse.f = 6.005; })), "");
  expect_refused(with([](auto& m) { m.transverse.e = 5, m.transverse.f = 6; }), "transverse has a pole", "e^2 < 4f");
}

TEST(FabricCheck, NamesTheConstantAndTheCure) {
  expect_refused(with([](auto& m) { m.density = -784; }), "density is -784", "areal density over thickness");
  expect_refused(with([](auto& m) { m.density = 0; }), "density is 0", "above 0");
  expect_refused(with([](auto& m) { m.warp.unload = 0; }), "warp.unload is 0", "0.4 as printed");
  expect_refused(with([](auto& m) { m.fill.unload = -0.1; }), "fill.unload is -0.1", "more than 0");
  expect_refused(with([](auto& m) { m.fill.rupture = 0; }), "fill.rupture is 0", "largest load");
  expect_refused(with([](auto& m) { m.warp.fit.a = -1; }), "warp.a is -1", "initial modulus");
  expect_refused(with([](auto& m) { m.warp.fit.c = NAN; }), "warp.c is nan", "give a number");
  expect_refused(with([](auto& m) { m.warp.fit.d *= 10; }), "warp stress at E = ", "signs and units");
  expect_refused(with([](auto& m) { m.transverse.b = -m.transverse.b; }), "transverse stress at E = ", "a pressed fabric pushes");
  expect_refused(with([](auto& m) { m.through.modulus = -1; }), "through.modulus is -1", "0 or more");
  expect_refused(with([](auto& m) { m.in_plane = awg_shear(), m.in_plane.second_angle = 0.2; }), "in_plane.second_angle is 0.2", "grow");
  expect_refused(with([](auto& m) { m.in_plane.first_angle = 0.3; }), "in_plane.stiffer is 0", "modulus above 0");
  expect_refused(with([](auto& m) { m.solid = SolidHandOver{.density = 700}; }), "solid.density is 700", "denser");
  expect_refused(with([](auto& m) { m.solid = SolidHandOver{.bulk_modulus = 0}; }), "solid.bulk_modulus is 0", "more than 0");
  expect_refused(with([](auto& m) { m.rate = RateFactor{.C = -0.1}; }), "rate.C is -0.1", "0 or more");
  expect_refused(with([](auto& m) { m.rate = RateFactor{.reference_rate = 0}; }), "rate.reference_rate is 0", "1/s");
  expect_refused(with([](auto& m) { m.coupling = -1; }), "coupling is -1", "0 (none) or more");
  expect_refused(HookeSolid{.young = 0, .poisson = 0.2, .density = 1440}, "young is 0", "Pa");
  expect_refused(HookeSolid{.young = 74e9, .poisson = 0.5, .density = 1440}, "poisson is 0.5", "between -1 and 0.5");
  expect_refused(HookeSolid{.young = 74e9, .poisson = 0.2, .density = -1}, "density is -1", "above 0");
}

} // namespace
} // namespace ballast
