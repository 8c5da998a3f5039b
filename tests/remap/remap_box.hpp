#pragma once
// RemapBox: the smallest owner of everything a remap::Mesh views, on a box of cells. Tests fill it, move
// its nodes and ask for totals; it knows grids and stores only, no block and no equation of state.

#include "core/boundary.hpp"
#include "core/hex_geometry.hpp"
#include "remap/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace ballast::remap {

template <int Dim> using Point = std::array<double, Dim>;

struct BoxShape {
  std::array<int, 3> cells = {8, 8, 1};
  std::array<double, 3> low = {0, 0, 0}, high = {1, 1, 1};
  bool axisymmetric = false;
  int materials = 1; ///< with density, in priority order
  bool has_void = false;
  BoundaryKind boundary = BoundaryKind::symmetry; ///< all sides
  int rows_per_tile = 4;
};

/// Sums over the box.
struct BoxTotals {
  std::vector<double> mass, volume; ///< by material
  double internal = 0, kinetic = 0;
  std::array<double, 3> momentum = {0, 0, 0};

  double energy() const { return internal + kinetic; }
};

template <int Dim> class RemapBox {
public:
  explicit RemapBox(const BoxShape& s) : shape(s), grid(Dim, s.cells) {
    for (auto* f : {&position, &target, &velocity, &next_velocity}) {
      f->fill(RowField::of_nodes(grid));
    }
    node_mass = RowField::of_nodes(grid);
    volume = next_volume = RowField::of_cells(grid);
    swept.fill(volume);
    mass_flux.fill(volume);
    owner.assign(static_cast<std::size_t>(grid.cell_pitch() * grid.cell_rows()), 0);
    for (int m = 0; m < s.materials + (s.has_void ? 1 : 0); ++m) {
      stores.emplace_back(grid, s.rows_per_tile, m < s.materials ? 3 : 1, 0);
    }
    for (auto& sides : boundary.side) {
      sides.fill({s.boundary, 0});
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      low_share[d].assign(static_cast<std::size_t>(grid.cells[d] + 2 * grid.ghost[d]), 0.5);
    }
    for (int i = 0; s.axisymmetric && i < grid.cells[0]; ++i) {
      const double a = line(0, i), b = line(0, i + 1);
      low_share[0][static_cast<std::size_t>(i + grid.ghost[0])] = (2 * a + b) / (3 * (a + b));
    }
    place(position, [](const Point<Dim>& x) { return x; });
    target = position;
    update_volumes();
  }

  double line(int axis, int i) const {
    const auto d = static_cast<std::size_t>(axis);
    return shape.low[d] + (shape.high[d] - shape.low[d]) * i / grid.cells[d];
  }

  /// Nodes (ghosts too) to map(their place on the regular box).
  template <class Map> void place(std::array<RowField, Dim>& nodes, Map&& map) const {
    const int planes = Dim == 3 ? grid.cells[2] + grid.ghost[2] : 0;
    for (int k = -grid.ghost[2]; k <= planes; ++k) {
      for (int j = -grid.ghost[1]; j <= grid.cells[1] + grid.ghost[1]; ++j) {
        for (int i = -grid.ghost[0]; i <= grid.cells[0] + grid.ghost[0]; ++i) {
          const int index[3] = {i, j, k};
          Point<Dim> x;
          for (int d = 0; d < Dim; ++d) {
            x[static_cast<std::size_t>(d)] = line(d, index[d]);
          }
          x = map(x);
          for (std::size_t d = 0; d < Dim; ++d) {
            nodes[d].row(grid.node_row(j, k))[i] = x[d];
          }
        }
      }
    }
  }

  template <class Body> void for_each_cell(Body&& body) const {
    for (int k = 0; k < grid.cells[2]; ++k) {
      for (int j = 0; j < grid.cells[1]; ++j) {
        for (int i = 0; i < grid.cells[0]; ++i) {
          body(i, j, k);
        }
      }
    }
  }
  template <class Body> void for_each_node(Body&& body) const {
    for (int k = 0; k <= (Dim == 3 ? grid.cells[2] : 0); ++k) {
      for (int j = 0; j <= grid.cells[1]; ++j) {
        for (int i = 0; i <= grid.cells[0]; ++i) {
          body(i, j, k);
        }
      }
    }
  }

  Point<Dim> node(int i, int j, int k) const {
    Point<Dim> x;
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = position[d].row(grid.node_row(j, k))[i];
    }
    return x;
  }
  /// Mean of the corners.
  Point<Dim> centre(int i, int j, int k) const {
    Point<Dim> sum{};
    for (int c = 0; c < (1 << Dim); ++c) {
      const Point<Dim> x = node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
      for (std::size_t d = 0; d < Dim; ++d) {
        sum[d] += x[d] / (1 << Dim);
      }
    }
    return sum;
  }

  void update_volumes() {
    for_each_cell([&](int i, int j, int k) {
      std::array<Point<Dim>, 8> x{};
      static constexpr int order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
      for (int c = 0; c < (1 << Dim); ++c) {
        x[static_cast<std::size_t>(c)] = node(i + (order[c] & 1), j + (order[c] >> 1 & 1), k + (order[c] >> 2 & 1));
      }
      volume.row(grid.cell_row(j, k))[i] = cell_volume(x);
    });
  }

  void fill(int material, int i, int j, int k, double fraction, double density, double energy) {
    if (fraction <= 0) {
      return;
    }
    TileStore& s = stores[static_cast<std::size_t>(material)];
    const int r = grid.cell_row(j, k);
    s.allocate(s.tile_of(r));
    s.row(0, r)[i] = fraction;
    if (s.conserved() > 1) {
      s.row(1, r)[i] = density * (fraction * volume.row(r)[i]);
      s.row(2, r)[i] = energy;
    }
  }
  template <class Velocity> void set_velocity(Velocity&& u) {
    for_each_node([&](int i, int j, int k) {
      const Point<Dim> v = u(node(i, j, k));
      for (std::size_t d = 0; d < Dim; ++d) {
        velocity[d].row(grid.node_row(j, k))[i] = v[d];
      }
    });
  }
  void update_node_mass() { node_mass = shares_of_mass(); }
  RowField shares_of_mass() const {
    RowField out = RowField::of_nodes(grid);
    for_each_cell([&](int i, int j, int k) {
      const int index[3] = {i, j, k};
      double mass = 0;
      for (std::size_t m = 0; m < static_cast<std::size_t>(shape.materials); ++m) {
        mass += stores[m].row(1, grid.cell_row(j, k))[i];
      }
      for (int c = 0; c < (1 << Dim); ++c) {
        double share = mass;
        for (int d = 0; d < Dim; ++d) {
          const auto a = static_cast<std::size_t>(d);
          const double low = low_share[a][static_cast<std::size_t>(index[d] + grid.ghost[a])];
          share *= (c >> d & 1) != 0 ? 1 - low : low;
        }
        out.row(grid.node_row(j + (c >> 1 & 1), k + (c >> 2 & 1)))[i + (c & 1)] += share;
      }
    });
    return out;
  }

  double fraction(int material, int i, int j, int k) const {
    return stores[static_cast<std::size_t>(material)].row(0, grid.cell_row(j, k))[i];
  }
  double density(int material, int i, int j, int k) const {
    const TileStore& s = stores[static_cast<std::size_t>(material)];
    const int r = grid.cell_row(j, k);
    return s.row(1, r)[i] / (s.row(0, r)[i] * volume.row(r)[i]);
  }
  double energy(int material, int i, int j, int k) const {
    return stores[static_cast<std::size_t>(material)].row(2, grid.cell_row(j, k))[i];
  }

  BoxTotals totals() const {
    BoxTotals t;
    t.mass.assign(stores.size(), 0.0);
    t.volume = t.mass;
    for_each_cell([&](int i, int j, int k) {
      const int r = grid.cell_row(j, k);
      for (std::size_t m = 0; m < stores.size(); ++m) {
        t.volume[m] += stores[m].row(0, r)[i] * volume.row(r)[i];
        if (stores[m].conserved() > 1) {
          t.mass[m] += stores[m].row(1, r)[i];
          t.internal += stores[m].row(1, r)[i] * stores[m].row(2, r)[i];
        }
      }
    });
    for_each_node([&](int i, int j, int k) {
      const int r = grid.node_row(j, k);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double p = node_mass.row(r)[i] * velocity[d].row(r)[i];
        t.momentum[d] += p;
        t.kinetic += 0.5 * p * velocity[d].row(r)[i];
      }
    });
    return t;
  }

  Mesh<Dim> mesh() {
    Mesh<Dim> m{.grid = grid,
                .axisymmetric = shape.axisymmetric,
                .position = position,
                .target = target,
                .volume = volume,
                .next_volume = next_volume,
                .velocity = velocity,
                .next_velocity = next_velocity,
                .node_mass = node_mass,
                .low_share = low_share,
                .swept = swept,
                .mass_flux = mass_flux,
                .materials = {},
                .has_void = shape.has_void,
                .owner = owner,
                .exchange_velocity = [this](RowField& f, int component) {
                  exchange_nodes(grid, boundary, component, f);
                }};
    for (TileStore& s : stores) {
      m.materials.push_back(&s);
    }
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        m.open[axis][side] = boundary.open(static_cast<int>(axis), static_cast<int>(side));
        m.fed[axis][side] = m.has_void && boundary.side[axis][side].kind == BoundaryKind::free;
      }
    }
    m.outside = [last = static_cast<int>(stores.size()) - 1](int, int, const std::array<int, 3>&, std::vector<Outside>& parts) {
      parts.push_back({last}); // the void
    };
    return m;
  }

  /// Remaps to where map(regular place) puts the nodes.
  template <class Map> Report move_to(Map&& map, const Settings& settings, ThreadPool& pool, long order = 0) {
    place(target, map);
    Mesh<Dim> m = mesh();
    return remap(m, settings, pool, order);
  }

  BoxShape shape;
  Grid grid;
  BoundarySet boundary;
  std::array<RowField, Dim> position, target, velocity, next_velocity;
  RowField volume, next_volume, node_mass;
  std::array<std::vector<double>, Dim> low_share;
  std::array<RowField, Dim> swept, mass_flux;
  std::vector<std::int8_t> owner;
  std::vector<TileStore> stores; ///< void last, if any

private:
  double cell_volume(const std::array<Point<Dim>, 8>& x) const {
    if constexpr (Dim == 3) {
      HexGeometry h;
      for (std::size_t c = 0; c < 8; ++c) {
        h.x[c] = x[c][0];
        h.y[c] = x[c][1];
        h.z[c] = x[c][2];
      }
      return h.volume();
    } else {
      const auto volume_of = [&](auto quad) {
        for (std::size_t c = 0; c < 4; ++c) {
          quad.x[c] = x[c][0];
          quad.y[c] = x[c][1];
        }
        return quad.volume();
      };
      return shape.axisymmetric ? volume_of(QuadGeometry<true>{}) : volume_of(QuadGeometry<false>{});
    }
  }
};

} // namespace ballast::remap
