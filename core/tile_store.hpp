// TileStore: the fields of one material, allocated only in the tiles where it is present.
//
// A tile is a run of rows (ghost rows included). Fields come in two kinds: conserved ones, held twice
// because a remap sweep writes its result beside its input, and derived ones, held once. Reading a row
// of an absent tile gives zeros.
#pragma once

#include "core/grid.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace ballast {

class TileStore {
public:
  TileStore() = default;
  TileStore(const Grid& grid, int rows_per_tile, int conserved, int derived)
      : pitch_(grid.cell_pitch()), ghost_(grid.ghost[0]), rows_(grid.cell_rows()),
        rows_per_tile_(rows_per_tile), conserved_(conserved), derived_(derived),
        tiles_(static_cast<std::size_t>((rows_ + rows_per_tile - 1) / rows_per_tile)),
        zeros_(static_cast<std::size_t>(pitch_), 0.0) {}

  int conserved() const { return conserved_; }
  int derived() const { return derived_; }
  int tile_count() const { return static_cast<int>(tiles_.size()); }
  int rows_per_tile() const { return rows_per_tile_; }
  int tile_of(int row) const { return row / rows_per_tile_; }
  bool allocated(int tile) const { return tiles_[static_cast<std::size_t>(tile)] != nullptr; }
  bool has_row(int row) const { return allocated(tile_of(row)); }

  /// Field numbers: 0 .. conserved-1, then conserved .. conserved+derived-1.
  const double* row(int field, int r) const {
    const double* base = tiles_[static_cast<std::size_t>(tile_of(r))].get();
    return (base ? base + offset(slot(field), r) : zeros_.data()) + ghost_;
  }
  double* row(int field, int r) {
    return tiles_[static_cast<std::size_t>(tile_of(r))].get() + offset(slot(field), r) + ghost_;
  }
  /// Where a sweep writes conserved field `field`; becomes current with swap().
  double* next_row(int field, int r) {
    return tiles_[static_cast<std::size_t>(tile_of(r))].get() +
           offset(2 * field + 1 - current_, r) + ghost_;
  }
  void swap() { current_ = 1 - current_; }

  void allocate(int tile) {
    auto& t = tiles_[static_cast<std::size_t>(tile)];
    if (!t) {
      t = std::make_unique<double[]>(tile_doubles()); // zeros
    }
  }
  void release(int tile) { tiles_[static_cast<std::size_t>(tile)].reset(); }
  std::size_t tile_doubles() const {
    return static_cast<std::size_t>(2 * conserved_ + derived_) *
           static_cast<std::size_t>(rows_per_tile_) * static_cast<std::size_t>(pitch_);
  }
  /// Everything of one tile, and which half of the conserved fields is current: for checkpoints.
  double* tile_data(int tile) { return tiles_[static_cast<std::size_t>(tile)].get(); }
  const double* tile_data(int tile) const { return tiles_[static_cast<std::size_t>(tile)].get(); }
  int current() const { return current_; }
  void set_current(int current) { current_ = current; }
  /// Any nonzero value of `field` in the rows of `tile`?
  bool any(int field, int tile) const {
    if (!allocated(tile)) {
      return false;
    }
    const double* f = tiles_[static_cast<std::size_t>(tile)].get() +
                      offset(slot(field), tile * rows_per_tile_);
    const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(rows_per_tile_) * pitch_;
    return std::any_of(f, f + count, [](double v) { return v != 0; });
  }

private:
  int slot(int field) const {
    return field < conserved_ ? 2 * field + current_ : conserved_ + field;
  }
  std::ptrdiff_t offset(int slot_number, int r) const {
    return (static_cast<std::ptrdiff_t>(slot_number) * rows_per_tile_ + r % rows_per_tile_) * pitch_;
  }

  int pitch_ = 0, ghost_ = 0, rows_ = 0, rows_per_tile_ = 1, conserved_ = 0, derived_ = 0;
  int current_ = 0;
  std::vector<std::unique_ptr<double[]>> tiles_;
  std::vector<double> zeros_;
};

} // namespace ballast
