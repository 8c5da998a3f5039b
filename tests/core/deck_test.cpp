#include "core/deck_keys.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

const SectionSpec& sample() {
  static const SectionSpec spec = {
      "[sample]",
      "",
      {{.name = "speed",
        .kind = KeyKind::quantity,
        .doc = "",
        .dimension = Dimension::velocity,
        .range = positive()},
       {.name = "count", .kind = KeyKind::integer, .doc = "", .range = {1, 10}, .fallback = "3"},
       {.name = "table", .kind = KeyKind::table, .doc = ""},
       {.name = "list", .kind = KeyKind::tables, .doc = ""}}};
  return spec;
}

TEST(Deck, KeepsOrderAndPlaces) {
  Deck deck = Deck::parse("speed = \"3 mm/us\"\ncount = 4\n", "a.toml");
  const Section s = read_section(deck, deck.root(), sample());
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_DOUBLE_EQ(s.number("speed"), 3000);
  EXPECT_EQ(s.integer("count"), 4);
  EXPECT_EQ(deck.root().fields[0].first, "speed");
  EXPECT_EQ(deck.root().find("count")->place.line, 2);
  EXPECT_EQ(deck.root().find("count")->place.column, 9);
}

TEST(Deck, DefaultsAppearInTheTree) {
  Deck deck = Deck::parse("", "a.toml");
  EXPECT_EQ(read_section(deck, deck.root(), sample()).integer("count"), 3);
  EXPECT_EQ(write_toml(deck.root()), "count = 3\n");
}

TEST(Deck, ReportsAllErrorsWithCaretAndHint) {
  Deck deck = Deck::parse("sped = 3\nspeed = \"3 kg\"\ncount = 99\n", "a.toml");
  read_section(deck, deck.root(), sample());
  ASSERT_EQ(deck.errors().size(), 3u);
  const std::string report = deck.error_report();
  EXPECT_NE(report.find("a.toml:1:1: sped: unknown key; did you mean \"speed\"?"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("a.toml:2:9: speed: \"kg\" is not a unit of velocity"), std::string::npos)
      << report;
  EXPECT_NE(
      report.find("  speed = \"3 kg\"\n          ^^^^^^\n  allowed: velocity with a unit (m/s"),
      std::string::npos)
      << report;
  EXPECT_NE(report.find("a.toml:3:9: count: 99 is out of range"), std::string::npos) << report;
  EXPECT_THROW(deck.throw_if_errors(), Error);
}

TEST(Deck, SettingsOverrideAndAreBlamed) {
  const std::string text = "speed = 1\n[[list]]\nname = \"b\"\nx = 1\n[table]\ny = 2\n";
  Deck deck = Deck::parse(
      text, "a.toml", {"speed=2 km/s", "list.b.x=7", "list.0.name=c", "table.y=[1, 2]", "count=x"});
  const Section s = read_section(deck, deck.root(), sample());
  EXPECT_DOUBLE_EQ(s.number("speed"), 2000);
  EXPECT_DOUBLE_EQ(deck.root().find("list")->items[0].find("x")->number, 7);
  EXPECT_EQ(deck.root().find("list")->items[0].find("name")->text, "c");
  EXPECT_EQ(deck.root().find("table")->find("y")->items.size(), 2u);
  EXPECT_NE(deck.error_report().find("--set count=x: count:"), std::string::npos)
      << deck.error_report();
}

TEST(Deck, BadSettingsAreErrors) {
  for (const char* setting : {"speed", "=3", "list.4.x=1", "speed.x.y=1"}) {
    Deck deck = Deck::parse("speed = 1\nlist = []\n", "a.toml", {setting});
    EXPECT_FALSE(deck.clean()) << setting;
  }
}

TEST(Deck, WrittenTomlReadsBackToTheSameBits) {
  const std::string text =
      "a = 0.1\nb = [1.0, 2.5e-7]\nc = \"q\\\"\\\\\"\nd = { e = true, f = \"g\" }\n[[h]]\ni = 3\n";
  const std::string once = write_toml(Deck::parse(text, "a").root());
  EXPECT_EQ(once, write_toml(Deck::parse(once, "b").root()));
  EXPECT_EQ(Deck::parse(once, "b").root().find("a")->number, 0.1);
}

TEST(Deck, NearestMeansWhatWasMistyped) {
  const std::vector<std::string> known = {"end_time", "title", "geometry"};
  EXPECT_EQ(nearest("end_tme", known), "end_time");
  EXPECT_EQ(nearest("Title", known), "title");
  EXPECT_EQ(nearest("viscosity", known), "");
}

TEST(Deck, MissingFileThrows) {
  EXPECT_THROW(Deck::load("/nowhere/x.toml"), Error);
}

} // namespace
} // namespace ballast
