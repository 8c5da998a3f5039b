// Decks as texts, read and run by tests.
#pragma once

#include "problems/run_session.hpp"
#include "tests/io/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace ballast {

/// Throws what is wrong with the deck.
inline SceneSpec spec_of(const std::string& text) {
  Deck d = Deck::parse(text, "test.toml", {});
  SceneSpec s = read_scene(d);
  d.throw_if_errors();
  return s;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  EXPECT_TRUE(in.good()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What a run leaves behind.
struct Written {
  nlohmann::json summary;
  std::string history, back_face; ///< the last: of the first dump of one stack, if there is one
};

template <int Dim> Written run_written(const ReadScene& read, int threads) {
  const io::TemporaryFolder folder;
  const std::filesystem::path dir = folder.path() / "run", back_face = dir / "back_face_0001.csv";
  EXPECT_EQ(RunSession<Dim>(read, dir, threads, "").run(), 0);
  return {nlohmann::json::parse(text_of(dir / "summary.json")), text_of(dir / "history.csv"), std::filesystem::exists(back_face) ? text_of(back_face) : ""};
}

/// Runs a deck given as its text.
template <int Dim> Written run_text(const std::string& text, int threads) {
  const io::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "deck.toml";
  std::ofstream(file) << text;
  return run_written<Dim>(read_scene(file.string(), {}), threads);
}

} // namespace ballast
