// What lies on either side of a stack inside the mesh: whether anything has come through.
#include "ale/embedding_cells.hpp"

namespace ballast {

namespace {

/// Middle of the last layer that is left of a planar or axisymmetric stack over the first axis, across holes: scraps of others may be anywhere.
std::vector<std::array<double, 2>> middle_of(const LayerStack<2>& s) {
  std::vector<std::array<double, 2>> line;
  for (int i = 0; i <= s.grid.elements[0]; ++i) {
    int last = -1;
    for (int level = 0; level < s.grid.levels(); ++level) {
      const bool there = (i > 0 && s.alive[s.element(i - 1, 0, level)] != 0) || (i < s.grid.elements[0] && s.alive[s.element(i, 0, level)] != 0);
      last = there ? level : last;
    }
    if (last >= 0) {
      const int first = last / s.grid.through * s.grid.through;
      const std::size_t low = s.node(i, 0, s.plane_below(first)), high = s.node(i, 0, s.plane_below(last) + 1);
      line.push_back({0.5 * (s.position[0][low] + s.position[0][high]), 0.5 * (s.position[1][low] + s.position[1][high])});
    }
  }
  std::sort(line.begin(), line.end());
  return line;
}

double height(const std::vector<std::array<double, 2>>& line, double x) {
  const auto next = std::lower_bound(line.begin(), line.end(), x, [](const std::array<double, 2>& p, double at) { return p[0] < at; });
  if (next == line.begin() || next == line.end()) {
    return next == line.begin() ? line.front()[1] : line.back()[1];
  }
  const auto& a = *(next - 1);
  return a[1] + (x - a[0]) / ((*next)[0] - a[0]) * ((*next)[1] - a[1]);
}

} // namespace

template <> std::vector<std::array<double, 2>> masses_by_side(const Scene<2>& scene, std::size_t stack) {
  if (scene.embedded.empty()) {
    return {};
  }
  const Embedding<2>& e = *scene.embedded.front();
  const Block<2>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const LayerStack<2>& layers = scene.layers[stack].stack;
  const std::vector<std::array<double, 2>> line = middle_of(layers);
  const std::size_t last_layer = layers.node(0, 0, layers.plane_below((layers.grid.layers - 1) * layers.grid.through));
  std::vector<std::array<double, 2>> mass(b.materials.size() - (b.void_index() >= 0 ? 1 : 0), {0, 0});
  if (line.empty()) {
    return {};
  }
  for_cells<2>(g, [&](int i, int j, int k) {
    const int r = g.cell_row(j, k);
    int side = -1; // that the surface beside the cell has
    std::array<double, 2> centre = {0, 0};
    for (int p = 0; p < 4; ++p) {
      const auto step = corner_step<2>(p);
      const int row = g.node_row(j + step[1], k), n = i + step[0], at = e.now.foot_of.empty() ? -1 : e.now.foot_of[node_at(g, row, n)];
      centre[0] += 0.25 * b.position[0].row(row)[n];
      centre[1] += 0.25 * b.position[1].row(row)[n];
      if (at >= 0 && e.now.level.row(row)[n] > 0) {
        const NodeFoot<2>& f = e.now.feet[static_cast<std::size_t>(at)];
        const bool of_last = f.stack == static_cast<int>(stack) && f.foot.side < 2 && f.foot.node[0] >= last_layer;
        side = of_last ? f.foot.side : side;
      }
    }
    const std::size_t on = side >= 0 ? static_cast<std::size_t>(side) : centre[1] > height(line, centre[0]) ? 1 : 0;
    for (std::size_t m = 0; m < mass.size(); ++m) {
      if (b.materials[m].store.has_row(r)) {
        mass[m][on] += b.materials[m].store.row(field::mass, r)[i];
      }
    }
  });
  return mass;
}
template <> std::vector<std::array<double, 2>> masses_by_side(const Scene<3>&, std::size_t) { return {}; } // no stacks inside 3D meshes yet

} // namespace ballast
