// Lines of an axis from a deck's section: `from`, `to` and `size` or `cells`.
#pragma once

#include "core/deck_keys.hpp"

#include <vector>

namespace ballast {

/// More cells than this are refused, along an axis or in all.
inline constexpr double most_cells = 2e8;

/// Does the section give either `size` or `cells`? An error where it gives both or neither.
bool check_size_or_cells(Deck& deck, const Section& in);

/// Where an axis begins and the rising places its sizes belong to, each with the node an error about it points to.
struct LinePlaces {
  double from = 0;
  std::vector<double> to;
  std::vector<DeckNode*> nodes;
};

/// Lines through places by the section's `size` or `cells`; sizes are divided by `refine`, a count of cells is times it.
/// Empty, and an error, where they do not fit.
std::vector<double> lines_through(Deck& deck, const Section& in, const LinePlaces& places, double refine, Dimension dimension);

/// The same with the places of `from` and `to`.
std::vector<double> read_lines(Deck& deck, const Section& in, double refine, Dimension dimension);

/// One quantity or a list of them, as a list; empty, and an error, if it is neither.
std::vector<double> read_places(Deck& deck, DeckNode& node, Dimension dimension, const KeyRange& range);

/// The node of entry i of a value that may be a list or a single one.
DeckNode& entry(DeckNode& node, std::size_t i);

} // namespace ballast
