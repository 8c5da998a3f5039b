// Open parts of hexahedra: 24 tetrahedra around the centres of faces and cell, whose levels are the means of their corners'. Their volumes add up to that of
// the hexahedron with bilinear faces (core/hex_geometry), and two cells see the same opening of the face between them.
// A tetrahedron's open part is its volume times a share that only levels know: with one open corner, product a / (a - l) over the other three.
#include "ale/embed/open_part.hpp"

#include "ale/embed/points.hpp"

#include <algorithm>

namespace ballast {

namespace {

using Point = std::array<double, 3>;

/// Open share of a tetrahedron, and its derivatives to the levels if asked for.
using Four = std::array<double, 4>;

/// Of one corner `p` at level a against the rest: product of a / (a - l).
double corner_share(const Four& l, std::size_t p, Four* d) {
  double share = 1, own = 0;
  Four out{};
  for (std::size_t q = 0; q < 4; ++q) {
    if (q != p) {
      const double gap = l[p] - l[q];
      share *= l[p] / gap;
      own -= l[q] / gap; // times share / a, below
      out[q] = 1 / gap;  // times share
    }
  }
  if (d != nullptr) {
    for (std::size_t q = 0; q < 4; ++q) {
      (*d)[q] = q == p ? (l[p] != 0 ? share * own / l[p] : 0.0) : share * out[q];
    }
  }
  return share;
}

/// Of two corners a, b > 0 against c, d: three tetrahedra of the wedge they leave.
double edge_share(const Four& l, const std::array<std::size_t, 4>& at, Four* d) {
  const double a = l[at[0]], b = l[at[1]], c = l[at[2]], e = l[at[3]];
  const double ac = a / (a - c), ad = a / (a - e), bc = b / (b - c), bd = b / (b - e);
  const double ac_left = -c / (a - c), ad_left = -e / (a - e), bc_left = -c / (b - c), bd_left = -e / (b - e); // 1 less these, to the last digit
  const double share = ac * ad * bd_left + ac * bd * bc_left + bc * bd;
  if (d != nullptr) {
    const double f_ac = ad * bd_left + bd * bc_left, f_ad = ac * bd_left, f_bc = bd * ac_left, f_bd = ac * ad_left + bc * ac_left;
    const auto high = [](double x, double y) { return -y / ((x - y) * (x - y)); }; // of x / (x - y) to x
    const auto low = [](double x, double y) { return x / ((x - y) * (x - y)); };  // to y
    (*d)[at[0]] = f_ac * high(a, c) + f_ad * high(a, e);
    (*d)[at[1]] = f_bc * high(b, c) + f_bd * high(b, e);
    (*d)[at[2]] = f_ac * low(a, c) + f_bc * low(b, c);
    (*d)[at[3]] = f_ad * low(a, e) + f_bd * low(b, e);
  }
  return share;
}

double open_share_of(const Four& l, Four* d = nullptr) {
  std::array<std::size_t, 4> at{}; // open ones first
  std::size_t open = 0, shut = 4;
  for (std::size_t q = 0; q < 4; ++q) {
    at[l[q] > 0 ? open++ : --shut] = q;
  }
  if (d != nullptr) {
    d->fill(0);
  }
  switch (open) {
  case 0: return 0;
  case 1: return corner_share(l, at[0], d);
  case 2: return edge_share(l, at, d);
  case 3: {
    const double shut_share = corner_share(l, at[3], d);
    for (std::size_t q = 0; d != nullptr && q < 4; ++q) {
      (*d)[q] = -(*d)[q];
    }
    return 1 - shut_share;
  }
  default: return 1;
  }
}

/// Corners of the faces, turning right-handed about the way out.
constexpr std::size_t face_corner[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Sum over the tetrahedra: one face's two corners, its centre, the cell's.
template <bool Derivatives> OpenPart<3> sum_tetrahedra(const LevelCell<3>& c) {
  OpenPart<3> out;
  Point middle = {0, 0, 0}, middle_gradient = {0, 0, 0};
  double middle_level = 0, to_middle_level = 0;
  for (std::size_t p = 0; p < 8; ++p) {
    middle_level += 0.125 * c.level[p];
    for (std::size_t d = 0; d < 3; ++d) {
      middle[d] += 0.125 * c.x[p][d];
    }
  }
  for (const auto& face : face_corner) {
    Point centre = {0, 0, 0}, centre_gradient = {0, 0, 0};
    double level = 0, to_level = 0;
    std::array<Point, 4> arm;
    for (std::size_t q = 0; q < 4; ++q) {
      level += 0.25 * c.level[face[q]];
      arm[q] = minus(c.x[face[q]], middle);
      for (std::size_t d = 0; d < 3; ++d) {
        centre[d] += 0.25 * arm[q][d];
      }
    }
    for (std::size_t q = 0; q < 4; ++q) {
      const std::size_t a = face[q], b = face[(q + 1) & 3];
      const Four l = {c.level[a], c.level[b], level, middle_level};
      Four to{};
      const double share = open_share_of(l, Derivatives ? &to : nullptr);
      if (share == 0) {
        continue;
      }
      const Point& va = arm[q];
      const Point& vb = arm[(q + 1) & 3];
      const Point to_a = cross(vb, centre);
      const double volume = dot(va, to_a) / 6;
      out.volume += share * volume;
      if constexpr (Derivatives) {
        const Point to_b = cross(centre, va), to_centre = cross(va, vb);
        const double w = share / 6;
        for (std::size_t d = 0; d < 3; ++d) {
          out.at_node[a][d] += w * to_a[d];
          out.at_node[b][d] += w * to_b[d];
          centre_gradient[d] += w * to_centre[d];
          middle_gradient[d] -= w * (to_a[d] + to_b[d] + to_centre[d]);
        }
        out.at_level[a] += volume * to[0];
        out.at_level[b] += volume * to[1];
        to_level += volume * to[2];
        to_middle_level += volume * to[3];
      }
    }
    for (std::size_t q = 0; Derivatives && q < 4; ++q) {
      out.at_level[face[q]] += 0.25 * to_level;
      for (std::size_t d = 0; d < 3; ++d) {
        out.at_node[face[q]][d] += 0.25 * centre_gradient[d];
      }
    }
  }
  for (std::size_t p = 0; Derivatives && p < 8; ++p) {
    out.at_level[p] += 0.125 * to_middle_level;
    for (std::size_t d = 0; d < 3; ++d) {
      out.at_node[p][d] += 0.125 * middle_gradient[d];
    }
  }
  return out;
}

struct LevelPoint {
  Point x;
  double level;
};
double open_tetrahedron(const LevelPoint& a, const LevelPoint& b, const LevelPoint& c, const LevelPoint& d) {
  const double share = open_share_of({a.level, b.level, c.level, d.level});
  return share == 0 ? 0.0 : share * dot(minus(b.x, a.x), cross(minus(c.x, a.x), minus(d.x, a.x))) / 6;
}

} // namespace

template <> OpenPart<3> open_part<3>(const LevelCell<3>& c, bool) { return sum_tetrahedra<true>(c); }

template <> double open_volume<3>(const LevelCell<3>& c, bool) { return sum_tetrahedra<false>(c).volume; }

template <> double open_share<3>(const std::array<double, 4>& level) {
  const double middle = 0.25 * (level[0] + level[1] + level[2] + level[3]);
  const auto corner = [](double a, double b, double c) { return a * a / ((a - b) * (a - c)); };
  double sum = 0;
  for (std::size_t q = 0; q < 4; ++q) {
    std::array<double, 3> l = {level[q], level[(q + 1) & 3], middle};
    std::sort(l.begin(), l.end());
    sum += l[0] > 0 ? 1.0 : l[1] > 0 ? 1 - corner(l[0], l[1], l[2]) : l[2] > 0 ? corner(l[2], l[1], l[0]) : 0.0;
  }
  return 0.25 * sum;
}

template <> double open_swept<3>(const SweptFace<3>& f, bool) {
  // Four triangles around the face's centre. Each sweeps a prism of three tetrahedra: what an edge sweeps is cut from where its lower node was to
  // where its upper one goes, in every face that has it; the nodes move along one coordinate, so it is plane.
  static constexpr std::size_t edge[4][2] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}}; // from the lower node up
  static constexpr double turn[4] = {1, 1, -1, -1};
  std::array<LevelPoint, 5> from{}, to{};
  from[4].level = to[4].level = 0;
  bool open = false;
  for (std::size_t q = 0; q < 4; ++q) {
    from[q] = {f.before[q], f.level_before[q]};
    to[q] = {f.after[q], f.level_after[q]};
    open = open || from[q].level > 0 || to[q].level > 0;
    from[4].level += 0.25 * from[q].level;
    to[4].level += 0.25 * to[q].level;
    for (std::size_t d = 0; d < 3; ++d) {
      from[4].x[d] += 0.25 * from[q].x[d];
      to[4].x[d] += 0.25 * to[q].x[d];
    }
  }
  double sum = 0;
  for (std::size_t q = 0; q < 4 && open; ++q) {
    const auto a = edge[q][0], b = edge[q][1];
    sum += turn[q] * (open_tetrahedron(from[a], from[b], from[4], to[4]) + open_tetrahedron(from[a], from[b], to[4], to[b]) + open_tetrahedron(from[a], to[a], to[b], to[4]));
  }
  return sum;
}

} // namespace ballast
