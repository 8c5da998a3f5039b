#include "post/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace ballast::post {
namespace {

constexpr std::array<Colour, 17> viridis_table{{{68, 1, 84},
                                                {72, 24, 106},
                                                {71, 45, 123},
                                                {66, 64, 134},
                                                {59, 82, 139},
                                                {51, 99, 141},
                                                {44, 114, 142},
                                                {38, 130, 142},
                                                {33, 145, 140},
                                                {31, 160, 136},
                                                {40, 174, 128},
                                                {63, 188, 115},
                                                {94, 201, 98},
                                                {132, 212, 75},
                                                {173, 220, 48},
                                                {216, 226, 25},
                                                {253, 231, 37}}};

// Crameri's vik at equal steps; the middle is lifted to near white so that zero leaves no tint.
constexpr std::array<Colour, 11> vik_table{{{0, 18, 97},
                                            {3, 62, 125},
                                            {30, 111, 157},
                                            {113, 168, 196},
                                            {201, 221, 231},
                                            {246, 244, 242},
                                            {234, 206, 189},
                                            {211, 151, 116},
                                            {190, 101, 51},
                                            {139, 39, 6},
                                            {89, 0, 7}}};

// Paul Tol's "bright" and "muted" colours, told apart by most colour-blind readers.
constexpr std::array<Colour, 12> materials{{{68, 119, 170},
                                            {221, 170, 51},
                                            {187, 85, 102},
                                            {68, 153, 119},
                                            {136, 85, 153},
                                            {102, 204, 238},
                                            {170, 130, 90},
                                            {238, 119, 51},
                                            {90, 90, 100},
                                            {204, 187, 68},
                                            {221, 130, 170},
                                            {17, 119, 51}}};

constexpr std::array<Colour, 8> lines{{{31, 87, 160},
                                       {204, 68, 40},
                                       {34, 136, 85},
                                       {140, 80, 160},
                                       {214, 145, 20},
                                       {60, 165, 200},
                                       {150, 90, 50},
                                       {90, 90, 96}}};

struct TellingWord {
  std::string_view word;
  Colour colour;
};
constexpr Colour pale{236, 239, 243};
constexpr std::array<TellingWord, 23> telling_words{{{"air", pale},
                                                     {"void", pale},
                                                     {"vacuum", pale},
                                                     {"gas", pale},
                                                     {"helium", pale},
                                                     {"lead", {92, 100, 112}},
                                                     {"copper", {196, 110, 60}},
                                                     {"gilding", {196, 110, 60}},
                                                     {"brass", {205, 165, 70}},
                                                     {"kevlar", {226, 178, 44}},
                                                     {"aramid", {226, 178, 44}},
                                                     {"muscle", {214, 128, 128}},
                                                     {"tissue", {226, 150, 140}},
                                                     {"skin", {236, 190, 165}},
                                                     {"gel", {240, 214, 150}},
                                                     {"bone", {190, 180, 150}},
                                                     {"rib", {190, 180, 150}},
                                                     {"lung", {232, 170, 190}},
                                                     {"water", {150, 195, 230}},
                                                     {"steel", {70, 105, 150}},
                                                     {"alumin", {168, 180, 196}},
                                                     {"al_", {168, 180, 196}},
                                                     {"ceramic", {120, 160, 140}}}};

bool same(Colour a, Colour b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// True if a word of `name` begins with `word`: "lead_core", not "fair".
bool tells(std::string_view name, std::string_view word) {
  const std::size_t at = name.find(word);
  return at != std::string_view::npos &&
         (at == 0 || !std::isalpha(static_cast<unsigned char>(name[at - 1])));
}

} // namespace

Colour ColourMap::operator()(double fraction) const {
  const double place = (from_ + (1 - from_) * std::clamp(fraction, 0.0, 1.0)) *
                       static_cast<double>(table_.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), table_.size() - 2);
  const double w = place - static_cast<double>(k);
  const auto blend = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1 - w) * a + w * b));
  };
  const Colour &a = table_[k], &b = table_[k + 1];
  return {blend(a.r, b.r), blend(a.g, b.g), blend(a.b, b.b)};
}

ColourMap viridis() {
  return {viridis_table, 0};
}
ColourMap diverging() {
  return {vik_table, 0};
}
ColourMap positive_half() {
  return {vik_table, 0.5};
}

std::vector<Colour> material_colours(std::span<const std::string> names) {
  std::vector<Colour> colours;
  const auto taken = [&](Colour c) {
    return std::any_of(
        colours.begin(), colours.end(), [&](Colour other) { return same(c, other); });
  };
  std::size_t next = 0;
  for (const std::string& name : names) {
    const auto word = std::find_if(telling_words.begin(),
                                   telling_words.end(),
                                   [&](const TellingWord& w) { return tells(name, w.word); });
    const bool told = word != telling_words.end() && !taken(word->colour);
    colours.push_back(told ? word->colour : materials[next++ % materials.size()]);
  }
  return colours;
}

Colour line_colour(std::size_t index) {
  return lines[index % lines.size()];
}

} // namespace ballast::post
