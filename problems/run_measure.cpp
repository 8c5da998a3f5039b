#include "problems/run_measure.hpp"

#include "ale/fill.hpp"
#include "problems/place_in_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

/// Mean over a cell's corners of the velocity of what slides there, or of the rest.
template <int Dim> double mean_velocity(const Block<Dim>& b, bool sliding, std::size_t d, int i, int j, int k) {
  double sum = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1));
    sum += velocity_of(b, sliding, d, r, i + (corner & 1));
  }
  return sum / (1 << Dim);
}

template <int Dim>
double node_mean(
    const Block<Dim>& b, const std::array<RowField, Dim>& f, std::size_t d, int i, int j, int k) {
  double sum = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    sum +=
        f[d].row(b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)))[i + (corner & 1)];
  }
  return sum / (1 << Dim);
}

/// Low and high position of a cell along an axis (means of its faces' nodes).
template <int Dim>
std::array<double, 2> cell_range(const Block<Dim>& b, int axis, int i, int j, int k) {
  std::array<double, 2> x = {0, 0};
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const double at = b.position[static_cast<std::size_t>(axis)].row(
        b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)))[i + (corner & 1)];
    x[static_cast<std::size_t>(corner >> axis & 1)] += at / (1 << (Dim - 1));
  }
  return x;
}

/// What the slots hold of a cell; nothing outside the block.
template <int Dim>
double
fraction_of(const Block<Dim>& b, const std::vector<int>& slots, const std::array<int, 3>& cell) {
  double f = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    if (cell[d] < 0 || cell[d] >= b.grid.cells[d]) {
      return 0;
    }
  }
  for (const int s : slots) {
    f += b.materials[static_cast<std::size_t>(s)].store.row(
        field::fraction, b.grid.cell_row(cell[1], cell[2]))[cell[0]];
  }
  return f;
}

/// How far what the slots hold of a cell (`f`, half of it or more) reaches along an axis (side -1
/// or 1): with what is in the next cell if that is less than half full, less what the cell behind
/// it lacks if that is half full: continuous as a surface, slanted too, passes from cell to cell.
template <int Dim>
double reach(const Block<Dim>& b,
             const std::vector<int>& slots,
             int axis,
             int side,
             std::array<int, 3> cell,
             double f) {
  const auto x = cell_range(b, axis, cell[0], cell[1], cell[2]);
  const std::size_t at = side > 0 ? 0 : 1;
  double end = x[at] + f * (x[1 - at] - x[at]);
  cell[static_cast<std::size_t>(axis)] -= side;
  const double behind = fraction_of(b, slots, cell);
  if (behind >= 0.5) {
    const auto y = cell_range(b, axis, cell[0], cell[1], cell[2]);
    end -= std::max(0.0, 1 - behind) * (y[1 - at] - y[at]);
  }
  cell[static_cast<std::size_t>(axis)] += 2 * side;
  const double beyond = fraction_of(b, slots, cell);
  if (beyond > 0 && beyond < 0.5) {
    const auto y = cell_range(b, axis, cell[0], cell[1], cell[2]);
    end += beyond * (y[1 - at] - y[at]);
  }
  return end;
}

/// Calls body(i, j, k) for the cells of each row r that span(r) names, in order.
template <int Dim, class Choice, class Body> void for_cells(const Block<Dim>& b, Choice&& span, Body&& body) {
  const Grid& g = b.grid;
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      const Span cells = span(g.cell_row(j, k));
      for (int i = cells.begin; i < cells.end; ++i) {
        body(i, j, k);
      }
    }
  }
}

/// The cells of a row from the first to the last that hold some of the slots.
template <int Dim> Span held_in_row(const Block<Dim>& b, const std::vector<int>& slots, int r) {
  Span cells;
  for (const int s : slots) {
    const TileStore& store = b.materials[static_cast<std::size_t>(s)].store;
    if (!store.has_row(r)) {
      continue;
    }
    const double* f = store.row(field::fraction, r);
    Span held{0, b.grid.cells[0]};
    while (!held.empty() && f[held.begin] == 0) {
      ++held.begin;
    }
    while (!held.empty() && f[held.end - 1] == 0) {
      --held.end;
    }
    cells = hull(cells, held);
  }
  return cells;
}

} // namespace

template <int Dim> double kinetic_energy(const Block<Dim>& b, int slot) {
  const MaterialSlot& material = b.materials[static_cast<std::size_t>(slot)];
  double sum = 0;
  const auto awake = [&](int r) { return material.store.has_row(r) ? b.awake.cells(r) : Span{}; }; // the others rest
  for_cells(b, awake, [&](int i, int j, int k) {
    const double mass = material.store.row(field::mass, b.grid.cell_row(j, k))[i];
    for (int corner = 0; mass > 0 && corner < (1 << Dim); ++corner) {
      const int node = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1));
      double square = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double u = velocity_of(b, material.slides, d, node, i + (corner & 1));
        square += u * u;
      }
      sum += 0.5 * mass * corner_share(b, corner, i, j, k) * square;
    }
  });
  return sum;
}

template <int Dim>
BodyMeasure
measure_body(const Block<Dim>& b, const std::vector<int>& slots, int axis, double direction) {
  BodyMeasure m;
  double low = std::numeric_limits<double>::infinity(), high = -low, momentum = 0;
  const auto held = [&](int r) { return held_in_row(b, slots, r); };
  for_cells(b, held, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    double mass = 0, sliding = 0;
    for (const int s : slots) {
      const MaterialSlot& slot = b.materials[static_cast<std::size_t>(s)];
      const double here = slot.store.row(field::mass, r)[i];
      mass += here;
      sliding += slot.slides ? here : 0.0;
    }
    const std::array<int, 3> cell = {i, j, k};
    const double f = fraction_of(b, slots, cell);
    if (f <= 0) {
      return;
    }
    m.mass += mass;
    const auto along = static_cast<std::size_t>(axis);
    momentum += (mass - sliding) * mean_velocity(b, false, along, i, j, k) + sliding * mean_velocity(b, true, along, i, j, k);
    if (f >= 0.5 && b.map.curved()) { // no rows across the shot: the nodes of its cells
      for (int d = 0; d < Dim; ++d) {
        const auto x = node_range(b, d, cell);
        low = d == axis ? std::min(low, x[0]) : low;
        high = d == axis ? std::max(high, x[1]) : high;
        m.radius = d == axis ? m.radius : std::max({m.radius, x[1], -x[0]});
      }
    } else if (f >= 0.5) {
      low = std::min(low, reach(b, slots, axis, -1, cell, f));
      high = std::max(high, reach(b, slots, axis, 1, cell, f));
      for (int other = 0; other < Dim; ++other) {
        if (other != axis) {
          m.radius = std::max(m.radius, reach(b, slots, other, 1, cell, f));
          m.radius = std::max(m.radius, -reach(b, slots, other, -1, cell, f));
        }
      }
    }
  });
  m.velocity = m.mass > 0 ? direction * momentum / m.mass : 0;
  m.front = direction > 0 ? high : low;
  m.rear = direction > 0 ? low : high;
  return m;
}

/// The cell row across axis `d` that begins at 0 or holds it: of a mesh on both sides of the shot line.
template <int Dim> int row_at_zero(const Block<Dim>& b, int d) {
  const int last = b.grid.cells[static_cast<std::size_t>(d)] - 1;
  for (int q = 0; q < last; ++q) {
    const auto x = cell_range(b, d, d == 0 ? q : 0, d == 1 ? q : 0, d == 2 ? q : 0);
    if (x[1] > 1e-9 * (x[1] - x[0])) {
      return q;
    }
  }
  return 0;
}

template <int Dim>
double cavity_radius(
    const Block<Dim>& b, int target, int axis, double from, double direction, double until) {
  const Grid& g = b.grid;
  const TileStore& store = b.materials[static_cast<std::size_t>(target)].store;
  double largest = 0;
  const int last = g.cells[static_cast<std::size_t>(axis)];
  if (axis == 0) {
    return 0; // a shot along i has no rows across it here
  }
  const int first = row_at_zero(b, 0), across = Dim == 3 ? row_at_zero(b, axis == 1 ? 2 : 1) : 0;
  for (int q = 0; q < last; ++q) {
    const int j = axis == 1 ? q : across, k = axis == 2 ? q : (Dim == 3 ? across : 0);
    const auto x = cell_range(b, axis, 0, j, k);
    const double middle = 0.5 * (x[0] + x[1]);
    if ((middle - from) * direction < 0 || (middle - until) * direction > 0) {
      continue;
    }
    const double* f = store.row(field::fraction, g.cell_row(j, k));
    for (const int side : {1, -1}) {
      const int begin = side > 0 ? first : first - 1, end = side > 0 ? g.cells[0] : -1;
      bool any = false; // none: in front of the target, behind it, or it is gone to the mesh's edge
      for (int i = begin; side * (end - i) > 0; i += side) {
        any = any || f[i] >= 0.999;
      }
      double area = 0, length = 0;
      for (int i = begin; any && side * (end - i) > 0 && f[i] < 0.999; i += side) {
        const auto r = cell_range(b, 0, i, j, k);
        area += (1 - f[i]) * (r[1] * r[1] - r[0] * r[0]);
        length += (1 - f[i]) * (r[1] - r[0]);
      }
      largest = std::max(largest, b.axisymmetric ? std::sqrt(area) : length);
    }
  }
  return largest;
}

/// From a cell on to the one that holds `at`, its faces taken at their means; as far as a mesh moves between remaps.
template <int Dim> std::array<int, 3> walk_to(const Block<Dim>& b, const std::array<double, 3>& at, std::array<int, 3> cell) {
  constexpr int farthest = 64;
  for (int step = 0; step < farthest; ++step) {
    const std::array<int, 3> before = cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto x = cell_range(b, static_cast<int>(d), cell[0], cell[1], cell[2]);
      cell[d] = std::clamp(cell[d] + (at[d] < x[0] ? -1 : at[d] > x[1] ? 1 : 0), 0, b.grid.cells[d] - 1);
    }
    if (cell == before) {
      break;
    }
  }
  return cell;
}

template <int Dim>
std::array<int, 3> find_cell(const Block<Dim>& b, const std::array<double, 3>& at) {
  const Grid& g = b.grid;
  std::array<int, 3> cell = {0, 0, 0};
  if (b.motion.remaps() && b.motion.policy != MotionPolicy::relax && !b.map.curved()) {
    const auto& lines = b.motion.policy == MotionPolicy::follow ? b.position : b.target;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      int c = 0;
      while (c + 1 < g.cells[a]) {
        const int j = axis == 1 ? c + 1 : 0, k = axis == 2 ? c + 1 : 0;
        if (lines[a].row(g.node_row(j, k))[axis == 0 ? c + 1 : 0] > at[a]) {
          break;
        }
        ++c;
      }
      cell[a] = c;
    }
    return b.motion.policy == MotionPolicy::eulerian ? walk_to(b, at, cell) : cell; // between remaps the mesh is on its way
  }
  double best = std::numeric_limits<double>::infinity();
  for_each_cell(b, [&](int i, int j, int k) {
    double distance = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double dx = node_mean<Dim>(b, b.position, d, i, j, k) - at[d];
      distance += dx * dx;
    }
    if (distance < best) {
      best = distance;
      cell = {i, j, k};
    }
  });
  return cell;
}

template <int Dim>
std::array<double, 3>
velocity_at(const Block<Dim>& b, const std::array<int, 3>& cell, const std::array<double, 3>& at) {
  std::array<double, 3> u{};
  std::array<double, Dim> part{};
  const bool sliding = mostly_slides(b, b.grid.cell_row(cell[1], cell[2]), cell[0]);
  for (int d = 0; d < Dim; ++d) {
    const auto x = cell_range(b, d, cell[0], cell[1], cell[2]);
    part[static_cast<std::size_t>(d)] = std::clamp((at[static_cast<std::size_t>(d)] - x[0]) / (x[1] - x[0]), 0.0, 1.0);
  }
  if (b.map.curved()) {
    part = place_in_cell(b, cell, at);
  }
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    double w = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      w *= corner >> d & 1 ? part[d] : 1 - part[d];
    }
    const int r = b.grid.node_row(cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
    for (std::size_t d = 0; d < Dim; ++d) {
      u[d] += w * velocity_of(b, sliding, d, r, cell[0] + (corner & 1));
    }
  }
  return u;
}

template double kinetic_energy<2>(const Block<2>&, int);
template double kinetic_energy<3>(const Block<3>&, int);
template BodyMeasure measure_body<2>(const Block<2>&, const std::vector<int>&, int, double);
template BodyMeasure measure_body<3>(const Block<3>&, const std::vector<int>&, int, double);
template double cavity_radius<2>(const Block<2>&, int, int, double, double, double);
template double cavity_radius<3>(const Block<3>&, int, int, double, double, double);
template std::array<int, 3> find_cell<2>(const Block<2>&, const std::array<double, 3>&);
template std::array<int, 3> find_cell<3>(const Block<3>&, const std::array<double, 3>&);
template std::array<double, 3>
velocity_at<2>(const Block<2>&, const std::array<int, 3>&, const std::array<double, 3>&);
template std::array<double, 3>
velocity_at<3>(const Block<3>&, const std::array<int, 3>&, const std::array<double, 3>&);

} // namespace ballast
