// Where the bodies are: levels of nodes, kinds of cells.
#include "ale/embedding_cells.hpp"

#include "ale/embedding_slits.hpp"

namespace ballast {

constexpr double reach_in_edges = 2.2; ///< of a node's longest edge: all nodes of cut cells and of their neighbours
constexpr double through_in_edges = 1.6; ///< likewise: a body may be open on its other side in one of the node's cells

template <int Dim> std::vector<LayerBody<Dim>> bodies_of(const Scene<Dim>& scene, const Embedding<Dim>& e) {
  std::vector<LayerBody<Dim>> out;
  const std::vector<std::vector<double>> own = own_thickness(scene, e);
  for (std::size_t s = 0; s < scene.layers.size(); ++s) {
    if constexpr (Dim == 3) {
      out.emplace_back(scene.layers[s].stack, e.alive[s], e.least_thickness[s], e.bin, *scene.pool, own[s]);
    } else {
      out.emplace_back(scene.layers[s].stack, e.alive[s], e.least_thickness[s], e.bin, own[s]);
    }
    out.back().set_longest_reach(reach_in_edges * e.longest_edge);
  }
  return out;
}

namespace {

/// m: what a body must be thick for the cells in a box of `reach_in_edges` of their edges (ale/embedding_thickness).
template <int Dim> double slit_width(const std::array<double, Dim>& box, const std::array<double, Dim>& normal) {
  double width = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    width += std::abs(normal[d]) * box[d] / reach_in_edges;
  }
  return spare_thickness * width;
}

/// Signs of nodes near bodies but out of reach of their surfaces. No surface crosses an edge between two of them, so those that hang together are all
/// inside or all outside, as most nodes around them are.
template <int Dim> class SignFinder {
public:
  explicit SignFinder(const Grid& g) : g_(g), state_(static_cast<std::size_t>(g.node_pitch()) * static_cast<std::size_t>(g.node_rows()), known) {}

  void add(const std::array<int, 3>& node) {
    state_[at(node)] = unknown;
    nodes_.push_back(node);
  }

  /// Makes negative the levels of those that are inside; calls inside(node) for each.
  template <class Visit> void run(RowField& level, Visit&& inside) {
    std::vector<std::array<int, 3>> part;
    for (const std::array<int, 3>& first : nodes_) {
      if (state_[at(first)] != unknown) {
        continue;
      }
      long votes = 0;
      part.assign(1, first);
      state_[at(first)] = of_a_part;
      for (std::size_t n = 0; n < part.size(); ++n) {
        const std::array<int, 3> node = part[n];
        for (std::size_t axis = 0; axis < Dim; ++axis) {
          for (const int side : {-1, 1}) {
            std::array<int, 3> to = node;
            to[axis] += side;
            if (to[axis] < 0 || to[axis] > g_.cells[axis]) {
              continue;
            }
            if (state_[at(to)] == unknown) {
              state_[at(to)] = of_a_part;
              part.push_back(to);
            } else if (state_[at(to)] == known) {
              votes += level.row(g_.node_row(to[1], to[2]))[to[0]] > 0 ? 1 : -1;
            }
          }
        }
      }
      for (const std::array<int, 3>& node : part) {
        if (votes < 0) {
          double& l = level.row(g_.node_row(node[1], node[2]))[node[0]];
          l = -std::abs(l);
          inside(node);
        }
      }
    }
  }

private:
  std::size_t at(const std::array<int, 3>& node) const { return node_at(g_, g_.node_row(node[1], node[2]), node[0]); }

  enum State : char { known, unknown, of_a_part }; ///< of a part: no vote
  const Grid& g_;
  std::vector<State> state_;
  std::vector<std::array<int, 3>> nodes_;
};

} // namespace

template <int Dim>
Levels<Dim> find_levels(const Grid& g, const std::array<RowField, Dim>& position, const std::vector<LayerBody<Dim>>& bodies, ThreadPool& pool) {
  Levels<Dim> out;
  out.level = RowField::of_nodes(g, 1.0);
  out.foot_of.assign(static_cast<std::size_t>(g.node_pitch()) * static_cast<std::size_t>(g.node_rows()), -1);
  double longest = 0; // far from the stacks edges may be longer: there nothing is near
  for (const LayerBody<Dim>& body : bodies) {
    longest = std::max(longest, body.longest_reach());
  }
  const int rows = (g.cells[1] + 1) * (Dim == 3 ? g.cells[2] + 1 : 1);
  std::vector<std::vector<NodeFoot<Dim>>> found(static_cast<std::size_t>(rows)); // by row of nodes
  std::vector<std::vector<int>> unknown(static_cast<std::size_t>(rows));
  std::vector<char> holds(static_cast<std::size_t>(rows), 0);
  using Starts = std::vector<std::array<int, 3>>; // by body: where the last node's feet are, the nearest, and those on side 0 and 1
  const auto foot_of = [&](std::size_t body, const std::array<double, Dim>& x, double reach, BodyFoot<Dim>& f, int side, int& start) {
    if constexpr (Dim == 3) {
      return bodies[body].foot(x, reach, f, side, &start);
    } else {
      return bodies[body].foot(x, reach, f, side);
    }
  };
  const auto near = [&](double low, double high, double reach) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const LayerBody<Dim>& body) { return body.near(low, high, reach); });
  };
  const auto level_of = [&](int i, int j, int k, std::vector<NodeFoot<Dim>>& feet, Starts& starts) {
    const int r = g.node_row(j, k);
    std::array<double, Dim> x{};
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = position[d].row(r)[i];
    }
    std::array<double, Dim> box = extents_at<Dim>(g, position, i, j, k);
    for (double& b : box) {
      b *= reach_in_edges;
    }
    if (!near(x[Dim - 1], x[Dim - 1], box[Dim - 1])) { // cells may be much longer along the layers than across
      return;
    }
    const double edge = edges_at<Dim>(g, position, i, j, k)[0], reach = reach_in_edges * edge;
    std::vector<StackFoot<Dim>> beside; // most nodes: one stack
    for (std::size_t s = 0; s < bodies.size(); ++s) {
      StackFoot<Dim> f{static_cast<int>(s), {}};
      if (bodies[s].may_touch(x, box) && foot_of(s, x, reach, f.foot, -1, starts[s][0])) {
        beside.push_back(f);
      }
    }
    double& level = out.level.row(r)[i];
    const auto add = [&](const StackFoot<Dim>& f) {
      out.foot_of[node_at(g, r, i)] = static_cast<int>(feet.size());
      level = f.foot.level;
      feet.push_back({f.foot, f.stack, r, i, -1, false, {}, {}});
    };
    const auto add_other = [&](const StackFoot<Dim>& f) {
      feet.back().other = static_cast<int>(feet.size());
      feet.push_back({f.foot, f.stack, r, i, -1, false, {}, {}});
    };
    const auto foot_on = [&](int stack, double within, int side, BodyFoot<Dim>& f) {
      const auto body = static_cast<std::size_t>(stack);
      return foot_of(body, x, within, f, side, starts[body][static_cast<std::size_t>(1 + side)]);
    };
    if (beside.size() > 1) {
      const auto seen = [&](const std::array<double, Dim>& normal) { return seen_slit * slit_width<Dim>(box, normal); };
      const JoinedFeet<Dim> joined = join_feet<Dim>(x, beside, seen, [&](int stack, int side, BodyFoot<Dim>& f) { return foot_on(stack, reach, side, f); });
      if (joined.closed) {
        level = joined.inside ? -reach : reach;
        holds[static_cast<std::size_t>(j + k * (g.cells[1] + 1))] = 1;
        if (!joined.feet.empty()) {
          add(joined.feet.front());
        }
        if (joined.inside && joined.feet.size() > 1) {
          add_other(joined.feet.back());
        }
        return;
      }
    }
    if (!beside.empty()) {
      const StackFoot<Dim>& best = *std::min_element(beside.begin(), beside.end(), [](const auto& a, const auto& b) { return a.foot.level < b.foot.level; });
      add(best);
      StackFoot<Dim> far{best.stack, {}};
      if (!(level > 0) && best.foot.side < 2 && foot_on(best.stack, through_in_edges * edge, 1 - best.foot.side, far.foot)) {
        add_other(far);
      }
      return;
    }
    level = reach;
    unknown[static_cast<std::size_t>(j + k * (g.cells[1] + 1))].push_back(i);
  };
  parallel_turns(pool, rows, [&](int row) { // rows near bodies lie together
    const double* across = position[Dim - 1].row(g.node_row(row % (g.cells[1] + 1), row / (g.cells[1] + 1)));
    const auto ends = std::minmax_element(across, across + g.cells[0] + 1);
    if (!near(*ends.first, *ends.second, longest)) {
      return;
    }
    Starts starts(bodies.size(), {-1, -1, -1});
    for (int i = 0; i <= g.cells[0]; ++i) {
      level_of(i, row % (g.cells[1] + 1), row / (g.cells[1] + 1), found[static_cast<std::size_t>(row)], starts);
    }
  });
  SignFinder<Dim> signs(g);
  for (int row = 0; row < rows; ++row) {
    for (const int i : unknown[static_cast<std::size_t>(row)]) {
      signs.add({i, row % (g.cells[1] + 1), row / (g.cells[1] + 1)});
    }
  }
  signs.run(out.level, [&](const std::array<int, 3>& node) { holds[static_cast<std::size_t>(node[1] + node[2] * (g.cells[1] + 1))] = 1; });
  for (int row = 0; row < rows; ++row) {
    const auto first = static_cast<int>(out.feet.size());
    const int across = Dim == 3 ? row / (g.cells[1] + 1) : row; // along the last axis
    if (holds[static_cast<std::size_t>(row)] != 0 || !found[static_cast<std::size_t>(row)].empty()) {
      out.rows = both_rows(out.rows, {across, across + 1});
    }
    for (NodeFoot<Dim>& f : found[static_cast<std::size_t>(row)]) {
      f.other += f.other >= 0 ? first : 0;
      out.feet.push_back(f);
    }
    const int r = g.node_row(row % (g.cells[1] + 1), row / (g.cells[1] + 1));
    for (int i = 0; i <= g.cells[0] && first > 0 && !found[static_cast<std::size_t>(row)].empty(); ++i) {
      int& at = out.foot_of[node_at(g, r, i)];
      at += at >= 0 ? first : 0;
    }
  }
  return out;
}

template <int Dim> int open_side(const Grid& g, const Levels<Dim>& levels, std::span<const std::array<int, 3>> nodes) {
  int side = -1;
  for (const std::array<int, 3>& n : nodes) {
    const int r = g.node_row(n[1], n[2]), at = levels.foot_of[node_at(g, r, n[0])];
    if (at < 0 || !(levels.level.row(r)[n[0]] > 0)) {
      continue;
    }
    const int here = faced_side(levels.feet[static_cast<std::size_t>(at)]);
    if (here < 0 || (side >= 0 && here != side)) {
      return -1;
    }
    side = here;
  }
  return side;
}

template <int Dim> double level_on(const Grid& g, const Levels<Dim>& levels, const std::array<int, 3>& n, int side) {
  const int r = g.node_row(n[1], n[2]), at = foot_on(levels, node_at(g, r, n[0]), side);
  return at < 0 ? levels.level.row(r)[n[0]] : levels.feet[static_cast<std::size_t>(at)].foot.level;
}

template <int Dim>
LevelCell<Dim> level_cell(const Grid& g, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, const std::array<int, 3>& cell, std::array<int, 1 << Dim>* feet) {
  LevelCell<Dim> out;
  std::array<std::array<int, 3>, 1 << Dim> nodes;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    nodes[static_cast<std::size_t>(p)] = {cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]};
  }
  const int side = open_side<Dim>(g, levels, nodes);
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const int r = g.node_row(nodes[p][1], nodes[p][2]), i = nodes[p][0];
    for (std::size_t d = 0; d < Dim; ++d) {
      out.x[p][d] = position[d].row(r)[i];
    }
    out.level[p] = level_on<Dim>(g, levels, nodes[p], side);
    if (feet != nullptr) {
      (*feet)[p] = foot_on(levels, node_at(g, r, i), side);
    }
  }
  return out;
}

template <int Dim>
void find_cells(const Block<Dim>& b, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, ThreadPool& pool, std::vector<int>& kind, std::vector<CutCell<Dim>>& cut) {
  const Grid& g = b.grid;
  kind.assign(static_cast<std::size_t>(g.cell_pitch()) * static_cast<std::size_t>(g.cell_rows()), open_cell);
  const RowsBeside rows = rows_beside<Dim>(g, levels.rows);
  std::vector<std::vector<CutCell<Dim>>> found(static_cast<std::size_t>(rows.count()));
  const auto look = [&](int i, int j, int k, std::vector<CutCell<Dim>>& here) {
    const int corners = open_corners<Dim>(g, levels, i, j, k);
    if (corners == 1 << Dim) {
      return;
    }
    int& what = kind[static_cast<std::size_t>(g.cell_row(j, k) * g.cell_pitch() + i + g.ghost[0])];
    what = covered_cell;
    if (corners == 0) {
      return;
    }
    std::array<int, 1 << Dim> feet{};
    const LevelCell<Dim> c = level_cell<Dim>(g, position, levels, {i, j, k}, &feet);
    const double whole = whole_volume<Dim>(b, position, i, j, k);
    const double open = open_volume(c, b.axisymmetric);
    if (open > least_open * whole) {
      here.push_back({{i, j, k}, g.cell_row(j, k), whole, edges_at<Dim>(g, position, i, j, k)[1], 0, false, -1, {}, 1, feet, open});
    }
  };
  parallel_rows(pool, rows, [&](int n, int j, int k) {
    for (int i = 0; i < g.cells[0]; ++i) {
      look(i, j, k, found[static_cast<std::size_t>(n)]);
    }
  });
  cut.clear();
  for (const std::vector<CutCell<Dim>>& here : found) {
    for (const CutCell<Dim>& c : here) {
      kind[static_cast<std::size_t>(c.row * g.cell_pitch() + c.cell[0] + g.ghost[0])] = static_cast<int>(cut.size());
      cut.push_back(c);
    }
  }
}

template <int Dim> double face_opening(const Grid& g, const Levels<Dim>& levels, int axis, const std::array<int, 3>& above) {
  const auto nodes = face_nodes<Dim>(axis, above);
  const int side = open_side<Dim>(g, levels, nodes);
  std::array<double, 1 << (Dim - 1)> level{};
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    level[q] = level_on<Dim>(g, levels, nodes[q], side);
  }
  return open_share<Dim>(level);
}

#define BALLAST_INSTANTIATE(D) \
  template std::vector<LayerBody<D>> bodies_of<D>(const Scene<D>&, const Embedding<D>&); \
  template Levels<D> find_levels<D>(const Grid&, const std::array<RowField, D>&, const std::vector<LayerBody<D>>&, ThreadPool&); \
  template LevelCell<D> level_cell<D>(const Grid&, const std::array<RowField, D>&, const Levels<D>&, const std::array<int, 3>&, std::array<int, 1 << D>*); \
  template int open_side<D>(const Grid&, const Levels<D>&, std::span<const std::array<int, 3>>); \
  template double level_on<D>(const Grid&, const Levels<D>&, const std::array<int, 3>&, int); \
  template void find_cells<D>(const Block<D>&, const std::array<RowField, D>&, const Levels<D>&, ThreadPool&, std::vector<int>&, std::vector<CutCell<D>>&); \
  template double face_opening<D>(const Grid&, const Levels<D>&, int, const std::array<int, 3>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
