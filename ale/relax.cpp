#include "ale/relax.hpp"

#include "ale/mesh_quality.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

/// On a sector displacements are smoothed as their parts along and across the radius at home: by x and y a contraction along all radii
/// would be no smooth one, and a few hundred remaps would press its lines together at the outer side.
bool is_sector(const MeshMap& map) {
  return map.kind == MapKind::polar || map.kind == MapKind::cylindrical || map.kind == MapKind::spherical;
}

/// What holds a node of the block's boundary.
enum class Hold { nothing, plane, place };

template <int Dim> Hold hold_at(const Block<Dim>& b, int axis, int index) {
  const int last = b.grid.cells[static_cast<std::size_t>(axis)];
  if (index > 0 && index < last) {
    return Hold::nothing;
  }
  return b.boundary.fixes_normal_velocity(axis, index == 0 ? 0 : 1) ? Hold::plane : Hold::place;
}

/// Along which axes a node is smoothed, and which of its components; none where it is held in place.
struct Freedom {
  std::array<bool, 3> along = {false, false, false}, component = {true, true, true};
  bool any = false;
};
template <int Dim> Freedom freedom_of(const Block<Dim>& b, const std::array<int, 3>& index) {
  Freedom f;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Hold hold = hold_at(b, axis, index[a]);
    if (hold == Hold::place) {
      return {};
    }
    f.along[a] = hold == Hold::nothing;
    if (hold == Hold::plane) {
      const int normal = b.boundary.normal_of(axis, index[a] == 0 ? 0 : 1);
      f.component[static_cast<std::size_t>(is_sector(b.map) && normal < 2 ? 1 : normal)] = false;
    }
    f.any = f.any || f.along[a];
  }
  return f;
}

/// Calls body(j, k) for every row of nodes, in slabs by thread.
template <int Dim, class Body> void for_each_node_row(const Grid& g, ThreadPool& pool, Body&& body) {
  const int planes = g.slabs() + 1, rows = Dim == 3 ? g.cells[1] + 1 : 1;
  parallel_ranges(pool, planes, [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      for (int q = 0; q < rows; ++q) {
        body(Dim == 3 ? q : plane, Dim == 3 ? plane : 0);
      }
    }
  });
}

/// One row of a sweep: u_next = (u + mean over the axes along which the nodes are free) / 2 where free, else u.
template <int Dim>
void smooth_row(const Block<Dim>& b, const std::array<RowField, Dim>& u, std::array<RowField, Dim>& next, int j, int k) {
  const Grid& g = b.grid;
  const int r = g.node_row(j, k), n = g.cells[0];
  const auto smooth = [&](int first, int last, const Freedom& f) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double* from = u[d].row(r);
      double* to = next[d].row(r);
      std::copy(from + first, from + last + 1, to + first);
      if (!f.any || !f.component[d]) {
        continue;
      }
      int axes = 0;
      for (std::size_t a = 0; a < Dim; ++a) {
        axes += f.along[a] ? 1 : 0;
      }
      const double part = 0.5 / axes;
      for (std::size_t a = 0; a < Dim; ++a) {
        if (!f.along[a]) {
          continue;
        }
        const int stride = g.node_row_stride(static_cast<int>(a)), step = a == 0 ? 1 : 0;
        const double *low = u[d].row(r - stride) - step, *high = u[d].row(r + stride) + step, *w = b.low_weight[a].row(r);
#pragma omp simd
        for (int i = first; i <= last; ++i) {
          to[i] += part * (w[i] * (low[i] - from[i]) + (1 - w[i]) * (high[i] - from[i]));
        }
      }
    }
  };
  for (const int i : {0, n}) {
    smooth(i, i, freedom_of(b, {i, j, k}));
  }
  smooth(1, n - 1, freedom_of(b, {1, j, k}));
}

/// The boundary nodes of a mesh that stays at its edges: at home, but free along a plane.
template <int Dim> void hold_at_home(const Block<Dim>& b, std::array<RowField, Dim>& u, ThreadPool& pool) {
  const Grid& g = b.grid;
  for_each_node_row<Dim>(g, pool, [&](int j, int k) {
    for (int i = 0; i <= g.cells[0]; ++i) {
      const std::array<int, 3> index = {i, j, k};
      bool held = false;
      for (int axis = 0; axis < Dim; ++axis) {
        held = held || hold_at(b, axis, index[static_cast<std::size_t>(axis)]) != Hold::nothing;
      }
      if (!held) {
        continue;
      }
      const Freedom f = freedom_of(b, index);
      for (std::size_t d = 0; d < Dim; ++d) {
        double& value = u[d].row(g.node_row(j, k))[i];
        value = f.any && f.component[d] ? value : 0.0;
      }
    }
  });
}

/// Displacements by x and y (r and z) to parts along and across the radius (`back`: the other way).
template <int Dim> void turn(const Block<Dim>& b, std::array<RowField, Dim>& u, bool back, ThreadPool& pool) {
  if (!is_sector(b.map)) {
    return;
  }
  for_each_node_row<Dim>(b.grid, pool, [&](int j, int k) {
    const int r = b.grid.node_row(j, k);
    for (int i = 0; i <= b.grid.cells[0]; ++i) {
      const double x = b.home[0].row(r)[i] - b.map.centre[0], y = b.home[1].row(r)[i] - b.map.centre[1], radius = std::sqrt(x * x + y * y);
      const double c = x / radius, s = back ? -y / radius : y / radius;
      double &a = u[0].row(r)[i], &t = u[1].row(r)[i];
      const double first = c * a + s * t;
      t = c * t - s * a;
      a = first;
    }
  });
}

template <int Dim> void go_to(const Block<Dim>& b, const std::array<RowField, Dim>& u, std::array<RowField, Dim>& target, ThreadPool& pool) {
  for_each_node_row<Dim>(b.grid, pool, [&](int j, int k) {
    const int r = b.grid.node_row(j, k);
    for (std::size_t d = 0; d < Dim; ++d) {
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        target[d].row(r)[i] = b.home[d].row(r)[i] + u[d].row(r)[i];
      }
    }
  });
}

/// Cells that the target would turn inside out, or near it, or make thinner where they are thin (less than `thin` and than most of what they were at
/// first), ascending; but none that it mends. Harmonic displacements know nothing of volumes: beside a concave free side they would press cells to slivers.
template <int Dim> std::vector<std::array<int, 3>> spoilt_cells(const Block<Dim>& b, double thin, const std::array<RowField, Dim>& target, ThreadPool& pool) {
  constexpr double poor = 0.02, thinned = 0.7, rounding = 1e-9;
  const Grid& g = b.grid;
  std::vector<std::vector<std::array<int, 3>>> by_slab(static_cast<std::size_t>(g.slabs()));
  parallel_ranges(pool, g.slabs(), [&](int begin, int end, int) {
    const auto n = static_cast<std::size_t>(g.cells[0]);
    std::vector<double> shape(n), shape_now(n), width(n), width_now(n), width_home(n);
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        row_quality(g, target, b.home, j, k, shape.data());
        row_quality(g, b.position, b.home, j, k, shape_now.data());
        row_thickness<Dim>(g, target, j, k, width.data());
        row_thickness<Dim>(g, b.position, j, k, width_now.data());
        row_thickness<Dim>(g, b.home, j, k, width_home.data());
        for (std::size_t i = 0; i < n; ++i) {
          const auto worse = [&](double then, double now, double bound) { return !(then > std::min(bound, now - rounding * std::abs(now))); };
          if (worse(shape[i], shape_now[i], poor) || worse(width[i], width_now[i], std::min(thin, thinned * width_home[i]))) {
            by_slab[static_cast<std::size_t>(s)].push_back({static_cast<int>(i), j, k});
          }
        }
      }
    }
  });
  std::vector<std::array<int, 3>> all;
  for (const auto& slab : by_slab) {
    all.insert(all.end(), slab.begin(), slab.end());
  }
  return all;
}

/// The nodes of these cells go back to where they are. By one thread: cells share nodes.
template <int Dim> void stay_at(const Block<Dim>& b, const std::vector<std::array<int, 3>>& cells, std::array<RowField, Dim>& target) {
  for (const auto& [i, j, k] : cells) {
    for (int c = 0; c < (1 << Dim); ++c) {
      const int r = b.grid.node_row(j + (c >> 1 & 1), k + (c >> 2));
      for (std::size_t d = 0; d < Dim; ++d) {
        target[d].row(r)[i + (c & 1)] = b.position[d].row(r)[i + (c & 1)];
      }
    }
  }
}

} // namespace

template <int Dim> void weigh_neighbours(Block<Dim>& b) {
  const Grid& g = b.grid;
  b.low_weight.fill(RowField::of_nodes(g, 0.5));
  ThreadPool one(1);
  for_each_node_row<Dim>(g, one, [&](int j, int k) {
    const std::array<int, 3> row = {0, j, k};
    const int r = g.node_row(j, k);
    for (std::size_t a = 0; a < Dim; ++a) {
      if (a > 0 && (row[a] == 0 || row[a] == g.cells[a])) {
        continue;
      }
      const int stride = g.node_row_stride(static_cast<int>(a)), step = a == 0 ? 1 : 0;
      for (int i = step; i <= g.cells[0] - step; ++i) {
        double below = 0, above = 0;
        for (std::size_t d = 0; d < Dim; ++d) {
          const double x = b.home[d].row(r)[i];
          below += std::pow(x - b.home[d].row(r - stride)[i - step], 2);
          above += std::pow(b.home[d].row(r + stride)[i + step] - x, 2);
        }
        b.low_weight[a].row(r)[i] = std::sqrt(above) / (std::sqrt(below) + std::sqrt(above));
      }
    }
  });
}

template <int Dim> void relax_target(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  // The step's next_position and next_velocity are free between steps.
  std::array<RowField, Dim>&u = b.next_position, &next = b.next_velocity;
  for_each_node_row<Dim>(g, pool, [&](int j, int k) {
    const int r = g.node_row(j, k);
    for (std::size_t d = 0; d < Dim; ++d) {
      for (int i = 0; i <= g.cells[0]; ++i) {
        u[d].row(r)[i] = b.position[d].row(r)[i] - b.home[d].row(r)[i];
      }
    }
  });
  turn<Dim>(b, u, false, pool);
  if (b.motion.fixed_boundary) {
    hold_at_home<Dim>(b, u, pool);
  }
  for (int sweep = 0; sweep < b.motion.sweeps; ++sweep) {
    for_each_node_row<Dim>(g, pool, [&](int j, int k) { smooth_row<Dim>(b, u, next, j, k); });
    u.swap(next);
  }
  turn<Dim>(b, u, true, pool);
  go_to<Dim>(b, u, b.target, pool);
  constexpr double margin = 1.05; // wider, and an evenly crushed block would not be smoothed at all
  const double thin = margin * least_thickness<Dim>(g, b.position, pool);
  constexpr int tries = 16; // each lets go of a wider neighbourhood of the spoilt cells
  auto spoilt = spoilt_cells<Dim>(b, thin, b.target, pool);
  for (int n = 0; n < tries && !spoilt.empty(); ++n) {
    stay_at<Dim>(b, spoilt, b.target);
    spoilt = spoilt_cells<Dim>(b, thin, b.target, pool);
  }
  if (!spoilt.empty()) {
    b.target = b.position;
  }
}

template void weigh_neighbours<2>(Block<2>&);
template void weigh_neighbours<3>(Block<3>&);
template void relax_target<2>(Block<2>&, ThreadPool&);
template void relax_target<3>(Block<3>&, ThreadPool&);

} // namespace ballast
