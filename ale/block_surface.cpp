#include "ale/block_surface.hpp"

#include <map>
#include <utility>

namespace ballast {

namespace {

/// Axes along which a block's node may not move: it lies on a plane of symmetry or a wall.
template <int Dim> unsigned held_axes(const Block<Dim>& b, const std::array<int, 3>& node) {
  unsigned held = 0;
  for (int a = 0; a < Dim; ++a) {
    for (int s = 0; s < 2; ++s) {
      const int at = s == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(a)];
      const int normal = b.boundary.normal_of(a, s);
      if (node[static_cast<std::size_t>(a)] == at && b.boundary.fixes_normal_velocity(a, s) && normal >= 0) {
        held |= 1U << normal;
      }
    }
  }
  return held;
}

/// Nodes of a side, one lower axis fastest, each edge's nodes once.
template <int Dim> BlockSurface<Dim> gather(const Block<Dim>& b, int axis, int side) {
  BlockSurface<Dim> s;
  s.axis = axis;
  s.side = side;
  std::array<int, 2> along{};
  int count = 0;
  for (int a = 0; a < Dim; ++a) {
    if (a != axis) {
      along[static_cast<std::size_t>(count)] = a;
      s.segments[static_cast<std::size_t>(count++)] = b.grid.cells[static_cast<std::size_t>(a)];
    }
  }
  const int rows = Dim == 3 ? s.segments[1] + 1 : 1;
  for (int q = 0; q < rows; ++q) {
    for (int p = 0; p <= s.segments[0]; ++p) {
      std::array<int, 3> node = {0, 0, 0};
      node[static_cast<std::size_t>(axis)] = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(axis)];
      node[static_cast<std::size_t>(along[0])] = p;
      if (Dim == 3) {
        node[static_cast<std::size_t>(along[1])] = q;
      }
      const int r = b.grid.node_row(node[1], node[2]), i = node[0];
      s.row.push_back(r);
      s.index.push_back(i);
      s.mass.push_back(b.node_mass.row(r)[i]);
      s.held.push_back(static_cast<unsigned char>(held_axes(b, node)));
      for (std::size_t d = 0; d < Dim; ++d) {
        s.origin[d].push_back(b.position[d].row(r)[i]);
        s.start[d].push_back(b.velocity[d].row(r)[i]);
        s.velocity[d].push_back(b.next_velocity[d].row(r)[i]);
      }
    }
  }
  s.position = s.origin;
  s.rest_of_way = s.start;
  for (auto& component : s.rest_of_way) {
    for (double& u : component) {
      u *= 0.5;
    }
  }
  return s;
}

/// Does X_,0 x X_,1 (3D), or the tangent turned left (2D), of a side point out of the block?
template <int Dim> int outside_of(int axis, int side) {
  const int up = Dim == 3 ? (axis == 1 ? -1 : 1) : (axis == 0 ? -1 : 1); // of the upper side: cyclic or not
  return side == 1 ? up : -up;
}

template <int Dim> void find_twins(std::vector<BlockSurface<Dim>>& sides) {
  std::map<std::pair<int, int>, std::vector<std::array<std::size_t, 2>>> seen; // by the block's node
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (std::size_t n = 0; n < sides[s].mass.size(); ++n) {
      seen[{sides[s].row[n], sides[s].index[n]}].push_back({s, n});
    }
  }
  for (const auto& [node, places] : seen) {
    for (const auto& a : places) {
      for (const auto& b : places) {
        if (a[0] != b[0]) {
          sides[a[0]].twins.push_back({a[1], b[0], b[1]});
        }
      }
    }
  }
}

} // namespace

template <int Dim> std::vector<BlockSurface<Dim>> gather_surfaces(const Block<Dim>& b) {
  std::vector<BlockSurface<Dim>> out;
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (b.boundary.at(axis, side).kind == BoundaryKind::free) {
        out.push_back(gather(b, axis, side));
      }
    }
  }
  find_twins(out);
  return out;
}

template <int Dim> void tell_twins(std::vector<BlockSurface<Dim>>& surfaces, std::size_t from) {
  for (const auto& twin : surfaces[from].twins) {
    for (std::size_t d = 0; d < Dim; ++d) {
      surfaces[twin.surface].velocity[d][twin.other] = surfaces[from].velocity[d][twin.node];
    }
  }
}

template <int Dim> ContactSurface<Dim> surface_at(BlockSurface<Dim>& s, double dt, double done) {
  const double left = (1 - done) * dt;
  ContactSurface<Dim> out;
  out.segments = s.segments;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (std::size_t n = 0; n < s.mass.size(); ++n) {
      s.rest_of_way[d][n] = (s.origin[d][n] + 0.5 * dt * s.start[d][n] - s.position[d][n]) / left;
    }
    out.position[d] = s.position[d].data();
    out.velocity[d] = s.velocity[d].data();
    out.velocity_n[d] = s.start[d].data();
    out.fixed[d] = s.rest_of_way[d].data();
  }
  out.mass = s.mass.data();
  out.weight = 0.5 * dt / left;
  out.rim = 1e-9; // rounding: past its corner the other side of the block is met
  out.outside = outside_of<Dim>(s.axis, s.side);
  out.held = s.held.data();
  return out;
}

template <int Dim> void follow_way(BlockSurface<Dim>& s, double dt, double done, double h) {
  const double left = (1 - done) * dt, weight = 0.5 * dt / left;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (std::size_t n = 0; n < s.mass.size(); ++n) {
      s.position[d][n] += h * (weight * s.velocity[d][n] + s.rest_of_way[d][n]);
    }
  }
}

template <int Dim> double scatter_surface(Block<Dim>& b, const BlockSurface<Dim>& s, double dt) {
  double energy = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (std::size_t n = 0; n < s.mass.size(); ++n) {
      double& next = b.next_velocity[d].row(s.row[n])[s.index[n]];
      const double change = s.velocity[d][n] - next, u = s.start[d][n]; // none where another side has told the block
      if (change == 0) {
        continue;
      }
      next = s.velocity[d][n];
      b.next_position[d].row(s.row[n])[s.index[n]] = s.origin[d][n] + 0.5 * dt * (u + next);
      energy += 0.5 * s.mass[n] * change * (u + next);
    }
  }
  return energy;
}

template std::vector<BlockSurface<2>> gather_surfaces<2>(const Block<2>&);
template std::vector<BlockSurface<3>> gather_surfaces<3>(const Block<3>&);
template ContactSurface<2> surface_at<2>(BlockSurface<2>&, double, double);
template ContactSurface<3> surface_at<3>(BlockSurface<3>&, double, double);
template void tell_twins<2>(std::vector<BlockSurface<2>>&, std::size_t);
template void tell_twins<3>(std::vector<BlockSurface<3>>&, std::size_t);
template void follow_way<2>(BlockSurface<2>&, double, double, double);
template void follow_way<3>(BlockSurface<3>&, double, double, double);
template double scatter_surface<2>(Block<2>&, const BlockSurface<2>&, double);
template double scatter_surface<3>(Block<3>&, const BlockSurface<3>&, double);

} // namespace ballast
