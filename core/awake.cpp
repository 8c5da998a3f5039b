#include "core/awake.hpp"

#include "core/boundary.hpp"

namespace ballast {

namespace {

constexpr int row_cost = 16;   ///< pure cells that an awake row costs besides its own
constexpr int mixed_cost = 24; ///< pure cells that a mixed cell costs besides itself

/// Grows the spans of rows [0, count), `stride` apart, to the hull of those within reach.
void spread(std::vector<Span>& spans, std::size_t first, std::size_t stride, int count) {
  std::vector<Span> line(static_cast<std::size_t>(count));
  for (int q = 0; q < count; ++q) {
    line[static_cast<std::size_t>(q)] = spans[first + static_cast<std::size_t>(q) * stride];
  }
  for (int q = 0; q < count; ++q) {
    Span& s = spans[first + static_cast<std::size_t>(q) * stride];
    for (int near = std::max(0, q - Awake::reach); near <= std::min(count - 1, q + Awake::reach); ++near) {
      s = hull(s, line[static_cast<std::size_t>(near)]);
    }
  }
}

} // namespace

Awake::Awake(const Grid& g) {
  recent_.assign(static_cast<std::size_t>(g.cell_rows()), Span{0, g.cells[0]});
  older_ = recent_;
  set(g, recent_);
}

void Awake::follow(const Grid& g, std::vector<Span> restless, bool remapped) {
  if (remapped) {
    older_.swap(recent_);
    recent_ = restless;
  }
  for (std::size_t r = 0; r < restless.size(); ++r) {
    recent_[r] = hull(recent_[r], restless[r]);
    restless[r] = hull(recent_[r], older_[r]);
  }
  set(g, restless);
}

void Awake::set(const Grid& g, const std::vector<Span>& restless) {
  cells_ = restless;
  const auto row = [&](int j, int k) { return static_cast<std::size_t>(g.cell_row(j, k)); };
  for (int k = 0; k < g.cells[2]; ++k) {
    spread(cells_, row(0, k), 1, g.cells[1]);
  }
  for (int j = 0; g.dim == 3 && j < g.cells[1]; ++j) {
    spread(cells_, row(j, 0), static_cast<std::size_t>(g.cell_rows_per_plane()), g.cells[2]);
  }
  long count = 0;
  for (int s = 0; s < g.slabs(); ++s) {
    for (int q = 0; q < g.rows_per_slab(); ++q) {
      const auto [j, k] = g.in_slab(s, q);
      Span& c = cells_[row(j, k)];
      if (!c.empty()) {
        c = {std::max(0, c.begin - reach) / tile * tile, std::min(g.cells[0], (c.end + reach + tile - 1) / tile * tile)};
        count += c.count();
      }
    }
  }
  weigh(g, std::vector<int>(static_cast<std::size_t>(g.slabs()), 0));
  share_ = static_cast<double>(count) / static_cast<double>(g.cell_count());
  for (int k = -g.ghost[2]; k < g.cells[2] + g.ghost[2]; ++k) {
    for (int j = -g.ghost[1]; j < g.cells[1] + g.ghost[1]; ++j) {
      const bool in_j = j >= 0 && j < g.cells[1], in_k = k >= 0 && k < g.cells[2];
      cells_[row(j, k)] = cells_[row(in_j ? j : mirrored_cell(j, g.cells[1]), in_k ? k : mirrored_cell(k, g.cells[2]))];
    }
  }
  nodes_.assign(static_cast<std::size_t>(g.node_rows()), {});
  for (int k = -g.ghost[2]; k < g.node_planes() - g.ghost[2]; ++k) {
    for (int j = -g.ghost[1]; j <= g.cells[1] + g.ghost[1]; ++j) {
      const int nj = std::clamp(j, 0, g.cells[1]), nk = g.dim == 3 ? std::clamp(k, 0, g.cells[2]) : 0;
      Span n = hull(cells_[row(nj - 1, nk)], cells_[row(nj, nk)]);
      if (g.dim == 3) {
        n = hull(n, hull(cells_[row(nj - 1, nk - 1)], cells_[row(nj, nk - 1)]));
      }
      nodes_[static_cast<std::size_t>(g.node_row(j, k))] = n.empty() ? n : Span{n.begin, n.end + 1};
    }
  }
}

void Awake::weigh(const Grid& g, const std::vector<int>& mixed) {
  before_.assign(static_cast<std::size_t>(g.slabs()) + 1, 0);
  for (int s = 0; s < g.slabs(); ++s) {
    const auto at = static_cast<std::size_t>(s);
    long cost = static_cast<long>(mixed_cost) * mixed[at];
    for (int q = 0; q < g.rows_per_slab(); ++q) {
      const auto [j, k] = g.in_slab(s, q);
      const Span& c = cells(g.cell_row(j, k));
      cost += c.empty() ? 0 : c.count() + row_cost;
    }
    before_[at + 1] = before_[at] + cost;
  }
}

int Awake::cut(int part, int parts) const {
  const long wanted = before_.back() * part / parts;
  return static_cast<int>(std::lower_bound(before_.begin(), before_.end(), wanted) - before_.begin());
}

} // namespace ballast
