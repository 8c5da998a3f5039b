// Several stacks in a scene: they touch as layers do, and a mesh sees those that lie face to face as one body.
#include "ale/embedding.hpp"
#include "tests/observers.hpp"
#include "tests/problems/restarts.hpp"
#include "tests/problems/run_deck.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

struct Part {
  std::string name;
  double front; ///< mm
  int layers;   ///< of 1 mm and a kg/m2
  double half_width = 20; ///< mm
};

std::string stack(const Part& p) {
  return fmt::format("[[layers]]\nname = \"{}\"\nfabric = \"kevlar_km2_raftenberg\"\nfront = \"{} mm\"\nlayers = {}\nplies = {}\nthickness = \"{} mm\"\nareal_density = \"{} kg/m2\"\n"
                     "half_width = \"{} mm\"\nsize = \"2 mm\"\nfriction = 0.2\n",
                     p.name, p.front, p.layers, 5 * p.layers, p.layers, 0.9 * p.layers, p.half_width);
}

enum class Way { contact, embedded };

/// A lead disc at 370 m/s; in 3D a quarter of it.
std::string deck(Geometry geometry, Way way, const std::vector<Part>& parts, double until = 15) {
  const bool solid = geometry == Geometry::three_d;
  std::string text = fmt::format("title = \"disc on stacks\"\ngeometry = \"{}\"\nend_time = \"{} us\"\n", solid ? "3d" : "axisymmetric", until);
  text += solid ? "symmetry = [\"x\", \"y\"]\n" : "";
  text += "[[body]]\nname = \"disc\"\nmaterial = \"lead\"\n";
  text += solid ? "velocity = [0, 0, \"370 m/s\"]\nshape = { cylinder = { from = [0, 0, \"-3 mm\"], to = [0, 0, 0], radius = \"6 mm\" } }\n"
                : "velocity = [0, \"370 m/s\"]\nshape = { cylinder = { from = [0, \"-3 mm\"], to = [0, 0], radius = \"6 mm\" } }\n";
  const bool own = way == Way::contact;
  text += "[mesh]\n";
  for (const char* axis : solid ? std::vector<const char*>{"x", "y"} : std::vector<const char*>{"r"}) {
    text += own ? fmt::format("{} = {{ from = 0, to = \"6 mm\", cells = 6 }}\n", axis) : fmt::format("{} = {{ from = 0, to = \"10 mm\", cells = 10 }}\n", axis);
  }
  text += own ? "z = { from = \"-3 mm\", to = 0, cells = 3 }\n" : "z = { from = \"-5 mm\", to = \"10 mm\", cells = 15 }\n";
  text += fmt::format("[motion]\npolicy = \"{}\"\nremap_every = 4\n[numerics]\nspall = false\n", own ? "relax" : "eulerian");
  for (const Part& p : parts) {
    text += stack(p);
  }
  return text + "[output]\nfields_every = \"20 us\"\n[results]\nbullet = [\"disc\"]\n";
}

template <int Dim> Written run(const std::string& text, int threads = 2) { return run_text<Dim>(text, threads); }

double deflection(const Written& w, const char* name) { return w.summary["results"]["layers"][name]["deflection_m"]["last"].get<double>(); }
double speed(const Written& w) { return w.summary["results"]["bullet"]["velocity_m_per_s"].get<double>(); }

const std::vector<Part> whole = {{"vest", 0, 4}};
const std::vector<Part> halves = {{"front", 0, 2}, {"back", 2, 2}};

/// Slidelines and contact between stacks are the same law: a stack cut in two gives the same shot.
TEST(Stacks, TwoThatTouchAreOne) {
  for (const Way way : {Way::contact, Way::embedded}) {
    const Written one = run<2>(deck(Geometry::axisymmetric, way, whole)), two = run<2>(deck(Geometry::axisymmetric, way, halves));
    EXPECT_NEAR(speed(two), speed(one), 0.01 * speed(one)) << static_cast<int>(way);
    EXPECT_NEAR(deflection(two, "back"), deflection(one, "vest"), 0.05 * deflection(one, "vest")) << static_cast<int>(way);
  }
}

/// Where they lie face to face at the start the mesh sees one body; with room between, the room too.
template <int Dim> void expect_one_body(Geometry geometry) {
  const auto scene_of = [&](const std::vector<Part>& parts) {
    Deck text = Deck::parse(deck(geometry, Way::embedded, parts), "test.toml", {});
    return build_scene<Dim>(read_scene(text), 2);
  };
  const Scene<Dim> one = scene_of(whole), two = scene_of(halves), apart = scene_of({{"front", 0, 2}, {"back", 4, 2}});
  EXPECT_EQ(one.embedded[0]->kind, two.embedded[0]->kind);
  const Grid& g = one.blocks[0].grid;
  double worst = 0;
  for (int k = 0; k <= (Dim == 3 ? g.cells[2] : 0); ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      for (int i = 0; i <= g.cells[0]; ++i) {
        const int r = g.node_row(j, k);
        worst = std::max(worst, std::abs(one.embedded[0]->now.level.row(r)[i] - two.embedded[0]->now.level.row(r)[i]));
      }
    }
  }
  EXPECT_LT(worst, 1e-12); // m
  const auto middle = [&](const Scene<Dim>& s) { // at z = 3 mm, between 2 and 4
    const int r = Dim == 3 ? g.node_row(3, 8) : g.node_row(8, 0);
    return s.embedded[0]->now.level.row(r)[3];
  };
  EXPECT_GT(middle(apart), 0);
  EXPECT_LT(middle(two), 0);
}

TEST(Stacks, FaceToFaceTheMeshSeesOneBody) {
  expect_one_body<2>(Geometry::axisymmetric);
  expect_one_body<3>(Geometry::three_d);
}

/// The front stack flies over a gap before it meets the other, no node of it passes, nothing is lost.
template <int Dim> void expect_conserved(Geometry geometry, Way way, const std::vector<Part>& parts, double until) {
  const nlohmann::json j = run<Dim>(deck(geometry, way, parts, until)).summary;
  EXPECT_LT(std::abs(j["conservation_errors"]["mass_relative"].get<double>()), 1e-12 + 1.001 * j["floors"]["sliver_mass_kg"].get<double>() / j["mass_kg"]["lead"]["start"].get<double>());
  EXPECT_LT(std::abs(j["conservation_errors"]["energy_relative"].get<double>()), 1e-10);
  const double start = j["momentum_kg_m_per_s"]["start"][Dim - 1], end = j["momentum_kg_m_per_s"]["end"][Dim - 1];
  EXPECT_NEAR(end + j["momentum_kg_m_per_s"]["left_block"][Dim - 1].get<double>(), start, 1e-12 * start);
  double loss = 0;
  for (const Part& p : parts) {
    const nlohmann::json& s = j["results"]["layers"][p.name];
    EXPECT_GT(s["momentum_kg_m_per_s"]["end"][Dim - 1].get<double>(), 0.01 * start) << p.name; // the disc, or the stack before it, pushed
    EXPECT_LT(s["penetration_deepest_m"].get<double>(), 1e-5) << p.name;
    EXPECT_EQ(s["inside_without_contact_node_steps"].get<long>(), 0) << p.name;
    loss += s["energy_J"]["contact_loss"].get<double>();
  }
  EXPECT_GT(loss, 0);
  const auto deflection = [&](const Part& p) { return j["results"]["layers"][p.name]["deflection_m"]["last"].get<double>(); };
  const Part &first = parts.front(), &last = parts.back();
  EXPECT_LT(deflection(first), deflection(last) + 1e-3 * (last.front - first.front - first.layers) + 5e-4 * last.layers); // its back face has not passed the other's front face, pressed to half
}

TEST(Stacks, WithRoomBetweenConserveMassMomentumAndEnergy) {
  const std::vector<Part> apart = {{"front", 0, 2}, {"back", 3.5, 2}};
  expect_conserved<2>(Geometry::axisymmetric, Way::contact, apart, 20);
  expect_conserved<2>(Geometry::axisymmetric, Way::embedded, apart, 20);
  expect_conserved<3>(Geometry::three_d, Way::embedded, apart, 14);
}

TEST(Stacks, ANarrowPlateBetweenTwoWideOnesDoesToo) {
  const std::vector<Part> three = {{"front", 0, 1}, {"plate", 1, 1, 8}, {"back", 2, 2}};
  expect_conserved<2>(Geometry::axisymmetric, Way::contact, three, 20);
  expect_conserved<2>(Geometry::axisymmetric, Way::embedded, three, 20);
}

/// Two plates of less than a cell with gas between, two cells where neither is padded, wherever they lie to the mesh's lines: it pushes each its own way
/// by p A t.
TEST(Stacks, GasInANarrowGapPushesThemApart) {
  constexpr double p = 10e6, t = 0.2e-6, radius = 5e-3, gap = 1.1, area = 3.14159265358979 * radius * radius;
  for (int offset = 0; offset < 5; ++offset) {
    const double low = 0.1 * offset; // mm
    const auto plate = [](const char* name, double front) {
      return fmt::format("[[layers]]\nname = \"{}\"\nfabric = \"plate\"\nfront = \"{} mm\"\nlayers = 1\nthickness = \"0.4 mm\"\ndensity = \"1440 kg/m3\"\nhalf_width = \"20 mm\"\ncells = 40\n", name, front);
    };
    const std::string text = fmt::format("title = \"gap\"\ngeometry = \"axisymmetric\"\nend_time = \"0.2 us\"\nambient = {{ pressure = \"0 Pa\" }}\n[[body]]\nname = \"gas\"\nmaterial = \"air\"\npressure = \"10 MPa\"\n"
                                         "density = \"100 kg/m3\"\nshape = {{ cylinder = {{ from = [0, \"{} mm\"], to = [0, \"{} mm\"], radius = \"5 mm\" }} }}\n[mesh]\n"
                                         "r = {{ from = 0, to = \"5 mm\", cells = 10, upper = \"symmetry\" }}\nz = {{ from = \"-4 mm\", to = \"5 mm\", cells = 18 }}\n[motion]\npolicy = \"eulerian\"\n"
                                         "[fabrics.plate]\nlaw = \"hooke\"\nyoung = \"70 GPa\"\npoisson = 0.3\n",
                                         low, low + gap) +
                             plate("lower", low - 0.4) + plate("upper", low + gap) + "[output]\nfields_every = \"1 us\"\n";
    const nlohmann::json j = run<2>(text).summary;
    const auto momentum = [&](const char* name) { return j["results"]["layers"][name]["momentum_kg_m_per_s"]["end"][1].get<double>(); };
    EXPECT_NEAR(momentum("upper"), p * area * t, 0.2 * p * area * t) << low;
    EXPECT_NEAR(momentum("lower"), -p * area * t, 0.2 * p * area * t) << low;
  }
}

template <int Dim> std::vector<double> state_of(const Scene<Dim>& scene) {
  std::vector<double> out;
  const auto add = [&](const std::vector<double>& values) { out.insert(out.end(), values.begin(), values.end()); };
  for (const Layers<Dim>& l : scene.layers) {
    out.insert(out.end(), {l.ledger.contact_loss, l.ledger.friction_loss, l.ledger.deepest});
    for (std::size_t d = 0; d < Dim; ++d) {
      add(l.stack.position[d]);
      add(l.stack.velocity[d]);
    }
    for (const StackContact<Dim>& c : l.with_stacks) {
      out.push_back(c.state.taken);
      add(c.state.tracks[0].gap);
      add(c.state.tracks[1].gap);
    }
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    add(scene.blocks[0].velocity[d].data());
  }
  return out;
}

TEST(Stacks, NeitherThreadsNorARestartChangeABit) {
  const std::string text = deck(Geometry::axisymmetric, Way::embedded, {{"front", 0, 2}, {"back", 2.5, 2}}), solid = deck(Geometry::three_d, Way::embedded, halves, 5);
  EXPECT_EQ(run<2>(text, 1).history, run<2>(text, 3).history);
  EXPECT_EQ(run<3>(solid, 1).history, run<3>(solid, 2).history);
  Deck parsed = Deck::parse(text, "test.toml", {});
  expect_restarts<2>(read_scene(parsed), {1, 60, 120}, [](const Scene<2>& scene) { return state_of(scene); });
}

TEST(Stacks, ThatOverlapOrShareANameAreRefused) {
  const auto errors = [](const std::vector<Part>& parts) {
    Deck text = Deck::parse(deck(Geometry::axisymmetric, Way::embedded, parts), "test.toml", {});
    read_scene(text);
    return text.error_report();
  };
  EXPECT_NE(errors({{"front", 0, 2}, {"back", 1.5, 2}}).find("overlaps \"front\""), std::string::npos);
  EXPECT_NE(errors({{"front", 0, 2}, {"front", 3, 2}}).find("two stacks are called \"front\""), std::string::npos);
  EXPECT_NE(errors({{"front plate", 0, 2}, {"front_plate", 3, 2}}).find("their files would be the same"), std::string::npos);
  EXPECT_EQ(errors(halves), "0 errors in test.toml\n");
}

} // namespace
} // namespace ballast
