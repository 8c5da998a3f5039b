// Every deck in tests/bad_decks is refused, at the line and key its first line names.
#include "problems/scene_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <sys/wait.h>

namespace ballast {
namespace {

namespace fs = std::filesystem;

struct Expected {
  int line = 0;
  std::string key;
};

/// "# expect: line 7 key mesh.r.size"; key "-": none, the deck is not TOML.
Expected expected_of(const fs::path& path) {
  std::ifstream in(path);
  std::string hash, expect, line, key;
  Expected out;
  in >> hash >> expect >> line >> out.line >> key >> out.key;
  EXPECT_EQ(hash + expect + line + key, "#expect:linekey") << path;
  out.key = out.key == "-" ? "" : out.key;
  return out;
}

std::vector<fs::path> bad_decks() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(BALLAST_SOURCE_DIR "/tests/bad_decks")) {
    if (entry.path().extension() == ".toml") {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Keys as a user would write them: an error in an entry or in a bare word counts as its key's.
bool same_key(const std::string& got, const std::string& wanted) {
  return got == wanted || got == wanted + ".type";
}

TEST(BadDecks, ThereAreEnough) {
  EXPECT_GE(bad_decks().size(), 60u);
}

TEST(BadDecks, AreRefusedWhereTheyAreWrong) {
  for (const fs::path& path : bad_decks()) {
    const Expected expected = expected_of(path);
    Deck deck = Deck::load(path.string());
    read_scene(deck);
    const bool found =
        std::any_of(deck.errors().begin(), deck.errors().end(), [&](const DeckError& e) {
          return e.place.line == expected.line && same_key(e.key, expected.key) &&
                 !e.message.empty();
        });
    EXPECT_TRUE(found) << path.filename() << ": expected line " << expected.line << " key "
                       << expected.key << ", got\n"
                       << deck.error_report();
    const std::string report = deck.error_report();
    EXPECT_NE(report.find(path.string() + ":" + std::to_string(expected.line) + ":"),
              std::string::npos)
        << report;
    EXPECT_NE(report.find("^"), std::string::npos) << report;
  }
}

TEST(BadDecks, OneMistakeGivesOneError) {
  for (const fs::path& path : bad_decks()) {
    if (path.stem() == "many_errors") {
      continue;
    }
    Deck deck = Deck::load(path.string());
    read_scene(deck);
    EXPECT_EQ(deck.errors().size(), 1u) << deck.error_report();
  }
}

TEST(BadDecks, AllErrorsComeInOnePass) {
  Deck deck = Deck::load(BALLAST_SOURCE_DIR "/tests/bad_decks/many_errors.toml");
  read_scene(deck);
  EXPECT_EQ(deck.errors().size(), 5u)
      << deck.error_report(); // geometry, end_time, titel, cfl, no mesh
}

/// The program itself, where it has been built beside the tests.
TEST(BadDecks, TheProgramExitsWith2AndWritesNothing) {
  const fs::path program =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "ballast";
  if (!fs::exists(program)) {
    GTEST_SKIP() << program << " is not built";
  }
  const fs::path out = fs::temp_directory_path() / fmt::format("ballast_bad_deck_out_{}", getpid());
  fs::remove_all(out);
  const std::vector<fs::path> all = bad_decks();
  for (std::size_t i = 0; i < all.size();
       i += 5) { // the reader itself is tested on every one above
    const fs::path& path = all[i];
    for (const std::string& word : {std::string("check"), "run --out " + out.string()}) {
      const std::string command =
          program.string() + " " + word + " " + path.string() + " > /dev/null 2>&1";
      const int raw = std::system(command.c_str());
      EXPECT_EQ(WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, 2) << command;
      EXPECT_FALSE(fs::exists(out)) << command;
    }
  }
}

} // namespace
} // namespace ballast
