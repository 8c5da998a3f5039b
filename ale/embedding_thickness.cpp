// How thick bodies must be for the cells around them.
#include "ale/embedding_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

/// Longest edges along each axis (m) of the cells around a place in the mesh that remaps lead to: of its own and two on either side.
template <int Dim> class EdgeFinder {
public:
  explicit EdgeFinder(const Block<Dim>& b) {
    const Grid& g = b.grid;
    for (std::size_t a = 0; a < Dim; ++a) {
      for (int n = 0; n <= g.cells[a]; ++n) {
        const int r = g.node_row(a == 1 ? n : 0, a == 2 ? n : 0);
        lines_[a].push_back(b.target[a].row(r)[a == 0 ? n : 0]);
      }
      for (int own = 0; own < g.cells[a]; ++own) {
        double longest = 0;
        for (int c = std::max(0, own - 2); c <= std::min(g.cells[a] - 1, own + 2); ++c) {
          longest = std::max(longest, lines_[a][static_cast<std::size_t>(c + 1)] - lines_[a][static_cast<std::size_t>(c)]);
        }
        longest_[a].push_back(longest);
      }
    }
  }
  std::array<double, Dim> at(const std::array<double, Dim>& x) const {
    std::array<double, Dim> longest{};
    for (std::size_t a = 0; a < Dim; ++a) {
      const std::vector<double>& line = lines_[a];
      const auto own = std::upper_bound(line.begin(), line.end(), x[a]) - line.begin() - 1;
      longest[a] = longest_[a][static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(own, 0, static_cast<std::ptrdiff_t>(line.size()) - 2))];
    }
    return longest;
  }

private:
  std::array<std::vector<double>, Dim> lines_, longest_;
};

/// Across the lower or upper face of an element, not unit.
template <int Dim> std::array<double, Dim> across_face(const LayerStack<Dim>& s, int i, int j, int plane) {
  const auto from = [&](int a, int b, int c, int d) { // one node to another
    const std::size_t low = s.node(i + a, j + b, plane), high = s.node(i + c, j + d, plane);
    std::array<double, Dim> out{};
    for (std::size_t n = 0; n < Dim; ++n) {
      out[n] = s.position[n][high] - s.position[n][low];
    }
    return out;
  };
  const std::array<double, Dim> u = from(0, 0, 1, Dim == 3 ? 1 : 0);
  if constexpr (Dim == 2) {
    return {-u[1], u[0]};
  } else {
    const std::array<double, Dim> v = from(1, 0, 0, 1);
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }
}

} // namespace

/// No cell may have open corners on both sides of a body: across it the body is as thick as the cells around it are wide, wherever it is by now.
template <int Dim> void find_least_thickness(const Scene<Dim>& scene, Embedding<Dim>& e) {
  constexpr double spare = 1.4; // cells are stretched until the next remap, layers bend
  const EdgeFinder<Dim> edges(scene.blocks[static_cast<std::size_t>(e.block)]);
  e.bin = std::numeric_limits<double>::infinity();
  e.longest_edge = 0;
  e.least_thickness.clear();
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const LayerStack<Dim>& s = scene.layers[q].stack;
    const std::size_t count = s.node(0, 0, 1);
    std::vector<double> thickness(count, 0.0);
    const auto visit = [&](std::size_t n, const std::array<double, Dim>& across, double length) {
      std::array<double, Dim> x{};
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d] = s.position[d][n];
      }
      const std::array<double, Dim> edge = edges.at(x);
      double width = 0, longest = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        width += length > 0 ? std::abs(across[d]) / length * edge[d] : edge[d];
        longest = std::max(longest, edge[d]);
      }
      thickness[n % count] = std::max(thickness[n % count], spare * width);
      e.bin = std::min(e.bin, 2 * longest);
      e.longest_edge = std::max(e.longest_edge, longest);
    };
    for (int level = 0; level < s.grid.levels(); ++level) {
      for (int j = 0; j < (Dim == 3 ? s.grid.elements[1] : 1); ++j) {
        for (int i = 0; i < s.grid.elements[0]; ++i) {
          if (e.alive[q][s.element(i, j, level)] == 0) {
            continue;
          }
          for (const int plane : {s.plane_below(level), s.plane_below(level) + 1}) {
            const std::array<double, Dim> across = across_face<Dim>(s, i, j, plane);
            double square = 0;
            for (const double a : across) {
              square += a * a;
            }
            for (int corner = 0; corner < (1 << (Dim - 1)); ++corner) {
              visit(s.node(i + (corner & 1), j + (corner >> 1), plane), across, std::sqrt(square));
            }
          }
        }
      }
    }
    e.least_thickness.push_back(std::move(thickness));
  }
}

template void find_least_thickness<2>(const Scene<2>&, Embedding<2>&);
template void find_least_thickness<3>(const Scene<3>&, Embedding<3>&);

} // namespace ballast
