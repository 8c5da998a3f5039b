// What lies on either side of a stack inside the mesh: whether anything has come through.
#include "ale/embedding_cells.hpp"

namespace ballast {

namespace {

/// Middle of the last layer that is left over node (i, j) of the planes; false if none is.
template <int Dim> bool middle_at(const LayerStack<Dim>& s, int i, int j, std::array<double, Dim>& out) {
  const auto there = [&](int a, int b, int level) {
    return a >= 0 && a < s.grid.elements[0] && b >= 0 && b < (Dim == 3 ? s.grid.elements[1] : 1) && s.alive[s.element(a, b, level)] != 0;
  };
  int last = -1;
  for (int level = 0; level < s.grid.levels(); ++level) {
    const bool any = there(i - 1, j, level) || there(i, j, level) || (Dim == 3 && (there(i - 1, j - 1, level) || there(i, j - 1, level)));
    last = any ? level : last;
  }
  if (last < 0) {
    return false;
  }
  const int first = last / s.grid.through * s.grid.through;
  const std::size_t low = s.node(i, j, s.plane_below(first)), high = s.node(i, j, s.plane_below(last) + 1);
  for (std::size_t d = 0; d < Dim; ++d) {
    out[d] = 0.5 * (s.position[d][low] + s.position[d][high]);
  }
  return true;
}

/// The last layer's middle over the plane, across holes: scraps of others may be anywhere.
template <int Dim> class LastLayer;

template <> class LastLayer<2> {
public:
  explicit LastLayer(const LayerStack<2>& s) {
    for (int i = 0; i <= s.grid.elements[0]; ++i) {
      std::array<double, 2> x{};
      if (middle_at<2>(s, i, 0, x)) {
        line_.push_back(x);
      }
    }
    std::sort(line_.begin(), line_.end());
  }
  bool empty() const { return line_.empty(); }
  double height(const std::array<double, 2>& at) const {
    const auto next = std::lower_bound(line_.begin(), line_.end(), at[0], [](const std::array<double, 2>& p, double x) { return p[0] < x; });
    if (next == line_.begin() || next == line_.end()) {
      return next == line_.begin() ? line_.front()[1] : line_.back()[1];
    }
    const auto& a = *(next - 1);
    return a[1] + (at[0] - a[0]) / ((*next)[0] - a[0]) * ((*next)[1] - a[1]);
  }

private:
  std::vector<std::array<double, 2>> line_;
};

/// Over the lines at rest: layers move little in their plane.
template <> class LastLayer<3> {
public:
  explicit LastLayer(const LayerStack<3>& s) : lines_(s.lines), width_(s.lines[0].size()), height_(s.lines[0].size() * s.lines[1].size()) {
    std::vector<std::size_t> known;
    std::vector<char> seen(height_.size(), 0);
    for (int j = 0; j <= s.grid.elements[1]; ++j) {
      for (int i = 0; i <= s.grid.elements[0]; ++i) {
        std::array<double, 3> x{};
        const std::size_t n = static_cast<std::size_t>(j) * width_ + static_cast<std::size_t>(i);
        if (middle_at<3>(s, i, j, x)) {
          height_[n] = x[2];
          seen[n] = 1;
          known.push_back(n);
        }
      }
    }
    empty_ = known.empty();
    for (std::size_t at = 0; at < known.size(); ++at) { // holes take on what is beside them
      const std::size_t n = known[at], i = n % width_;
      const auto take = [&](bool inside, std::size_t to) {
        if (inside && seen[to] == 0) {
          seen[to] = 1;
          height_[to] = height_[n];
          known.push_back(to);
        }
      };
      take(i > 0, n - 1);
      take(i + 1 < width_, n + 1);
      take(n >= width_, n - width_);
      take(n + width_ < height_.size(), n + width_);
    }
  }
  bool empty() const { return empty_; }
  double height(const std::array<double, 3>& at) const {
    std::array<std::size_t, 2> low{};
    std::array<double, 2> part{};
    for (std::size_t d = 0; d < 2; ++d) {
      const std::vector<double>& line = lines_[d];
      const auto next = std::upper_bound(line.begin(), line.end(), at[d]) - line.begin();
      low[d] = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next - 1, 0, static_cast<std::ptrdiff_t>(line.size()) - 2));
      part[d] = std::clamp((at[d] - line[low[d]]) / (line[low[d] + 1] - line[low[d]]), 0.0, 1.0);
    }
    const std::size_t n = low[1] * width_ + low[0];
    const auto along = [&](std::size_t row) { return (1 - part[0]) * height_[row] + part[0] * height_[row + 1]; };
    return (1 - part[1]) * along(n) + part[1] * along(n + width_);
  }

private:
  std::array<std::vector<double>, 2> lines_;
  std::size_t width_;
  std::vector<double> height_; ///< m: i fastest
  bool empty_ = true;
};

} // namespace

template <int Dim> std::vector<std::array<double, 2>> masses_by_side(const Scene<Dim>& scene, std::size_t stack) {
  if (scene.embedded.empty()) {
    return {};
  }
  const Embedding<Dim>& e = *scene.embedded.front();
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const LayerStack<Dim>& layers = scene.layers[stack].stack;
  const LastLayer<Dim> middle(layers);
  const std::size_t last_layer = layers.node(0, 0, layers.plane_below((layers.grid.layers - 1) * layers.grid.through));
  std::vector<std::array<double, 2>> mass(b.materials.size() - (b.void_index() >= 0 ? 1 : 0), {0, 0});
  if (middle.empty()) {
    return {};
  }
  for_cells<Dim>(g, [&](int i, int j, int k) {
    const int r = g.cell_row(j, k);
    int side = -1; // that the surface beside the cell has
    std::array<double, Dim> centre{};
    for (int p = 0; p < (1 << Dim); ++p) {
      const auto step = corner_step<Dim>(p);
      const int row = g.node_row(j + step[1], k + step[2]), n = i + step[0], at = e.now.foot_of.empty() ? -1 : e.now.foot_of[node_at(g, row, n)];
      for (std::size_t d = 0; d < Dim; ++d) {
        centre[d] += b.position[d].row(row)[n] / (1 << Dim);
      }
      if (at >= 0 && e.now.level.row(row)[n] > 0) {
        const NodeFoot<Dim>& f = e.now.feet[static_cast<std::size_t>(at)];
        const bool of_last = f.stack == static_cast<int>(stack) && f.foot.side < 2 && f.foot.node[0] >= last_layer;
        side = of_last ? f.foot.side : side;
      }
    }
    const std::size_t on = side >= 0 ? static_cast<std::size_t>(side) : centre[Dim - 1] > middle.height(centre) ? 1 : 0;
    for (std::size_t m = 0; m < mass.size(); ++m) {
      if (b.materials[m].store.has_row(r)) {
        mass[m][on] += b.materials[m].store.row(field::mass, r)[i];
      }
    }
  });
  return mass;
}

template std::vector<std::array<double, 2>> masses_by_side(const Scene<2>&, std::size_t);
template std::vector<std::array<double, 2>> masses_by_side(const Scene<3>&, std::size_t);

} // namespace ballast
