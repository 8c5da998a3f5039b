// Volumes of the materials that cross a row of faces.
#include "core/rows.hpp"
#include "remap/face_row.hpp"
#include "remap/reconstruct.hpp"

#include <algorithm>
#include <cmath>

namespace ballast::remap {

namespace {

constexpr double flush_fraction = 1e-6; ///< a donor left with less than this gives it all

/// A mixed cell that gives through a face.
struct Donor {
  int row, index, axis;
  double volume;   ///< m3 of the cell
  double swept;    ///< m3 through the face along +axis, not zero
  double opposite; ///< m3 that leave through the opposite face, not negative
};

/// Volumes of the materials in the slab that `swept` takes at the donor's high or low end.
template <int Dim>
void slabs(const Reconstruction<Dim>& cell, const Donor& donor, bool high, double swept, double* out) {
  const double part = std::min(1.0, swept / donor.volume);
  slab_volumes<Dim>(cell.planes, cell.count - 1, donor.axis, high ? 1 - part : 0.0, high ? 1.0 : part, out);
  for (int q = 0; q < cell.count; ++q) {
    out[q] *= donor.volume;
  }
}

/// Lowers what a face may take of each material (`most`, what the cell holds) so that the opposite face, which does the
/// same, can take its own: its slab, and of what neither slab holds the share that it needs to fill its total.
template <int Dim>
void leave_for_opposite(const Reconstruction<Dim>& cell, const Donor& donor, const double* slab, double* most) {
  double other[most_materials], own[most_materials], need = std::abs(donor.swept), other_need = donor.opposite;
  slabs(cell, donor, !(donor.swept > 0), donor.opposite, other);
  for (int q = 0; q < cell.count; ++q) {
    own[q] = std::min(slab[q], most[q] - std::min(other[q], most[q]));
    other[q] = std::min(other[q], most[q] - std::min(slab[q], most[q]));
    need -= own[q];
    other_need -= other[q];
  }
  const double both = std::max(need, 0.0) + std::max(other_need, 0.0), share = both > 0 ? std::max(need, 0.0) / both : 0.0;
  for (int q = 0; q < cell.count; ++q) {
    most[q] = own[q] + share * std::max(most[q] - own[q] - other[q], 0.0);
  }
}

/// Volumes that a mixed donor gives, into the materials' flux[0] at `face`. The two faces of a cell together take no more
/// volume of a material than there is.
template <int Dim> void mixed_donor(const Mesh<Dim>& m, const Settings& s, const Donor& donor, FaceRow& out, int face) {
  const Reconstruction<Dim> cell = reconstruct_cell<Dim>(m.grid, m.materials, s.normal, donor.row, donor.index);
  const int count = cell.count;
  const int* present = cell.present;
  double given[most_materials], most[most_materials], sum = 0;
  slabs(cell, donor, donor.swept > 0, std::abs(donor.swept), given);
  for (int q = 0; q < count; ++q) {
    most[q] = m.materials[static_cast<std::size_t>(present[q])]->row(0, donor.row)[donor.index] * donor.volume;
  }
  const bool both_give = donor.opposite > 0;
  if (both_give) {
    leave_for_opposite(cell, donor, given, most);
  }
  int largest = 0;
  for (int q = 0; q < count; ++q) {
    given[q] = std::min(given[q], most[q]);
    if (!both_give && most[q] - given[q] < flush_fraction * donor.volume && given[q] > 0) {
      given[q] = most[q]; // no sliver stays behind
    }
    sum += given[q];
    largest = most[q] - given[q] > most[largest] - given[largest] ? q : largest;
  }
  // The rest of the face's total comes from, or goes back to, whoever has most left.
  double rest = std::abs(donor.swept) - sum;
  for (int pass = 0; pass < count && rest != 0; ++pass) {
    const double take = std::clamp(rest, -given[largest], most[largest] - given[largest]);
    given[largest] += take;
    rest -= take;
    for (int q = 0; q < count; ++q) {
      const auto room = [&](int c) { return rest > 0 ? most[c] - given[c] : given[c]; };
      largest = room(q) > room(largest) ? q : largest;
    }
  }
  for (int q = 0; q < count; ++q) {
    if (given[q] > 0) {
      if (!out.present(present[q])) {
        out.set_present(present[q], true);
        double* f = out.flux(present[q], 0);
        std::fill(f, f + out.faces(), 0.0);
      }
      out.flux(present[q], 0)[face] = std::copysign(given[q], donor.swept);
      out.cross(present[q], {face, face + 1});
    }
  }
}

} // namespace

template <int Dim>
void volume_fluxes(const Mesh<Dim>& m, const Settings& s, int axis, const Line& line, int r_faces, FaceRow& out) {
  const Span faces = m.faces(axis, r_faces);
  const double* swept = m.swept[static_cast<std::size_t>(axis)].row(r_faces);
  const std::int8_t *below = m.owner_row(line.row[1]) + line.shift[1], *above = m.owner_row(line.row[2]) + line.shift[2];
  for (int k = 0; k < m.material_count(); ++k) {
    out.set_present(k, false);
  }
  const int sole = sole_owner(above, out.faces());
  out.sole = sole >= 0 && sole_owner(below, out.faces()) == sole ? sole : -1;
  if (out.sole >= 0) {
    out.set_present(sole, true);
    out.cross(sole, faces);
    double* flux = out.flux(sole, 0);
#pragma omp simd
    for (int i = faces.begin; i < faces.end; ++i) {
      flux[i] = 0.0 - swept[i];
    }
    return;
  }
  const int stride = m.grid.cell_row_stride(axis), step = axis == 0 ? 1 : 0;
  const double* next_swept = m.swept[static_cast<std::size_t>(axis)].row(r_faces + stride) + step;
  const double* last_swept = m.swept[static_cast<std::size_t>(axis)].row(r_faces - stride) - step;
  int current = -1, start = 0; // of the run of faces that one pure material crosses
  double* flux = nullptr;
  const auto end_run = [&](int end) {
    if (current >= 0) {
      out.cross(current, {start, end});
    }
  };
  for (int i = faces.begin; i < faces.end; ++i) {
    const double t = -swept[i];
    if (t == 0) {
      continue;
    }
    const int owner = t > 0 ? below[i] : above[i];
    if (owner < 0) {
      const double opposite = std::max(0.0, t > 0 ? last_swept[i] : -next_swept[i]);
      const int row = t > 0 ? line.row[1] : line.row[2], index = i + (t > 0 ? line.shift[1] : line.shift[2]);
      mixed_donor(m, s, {row, index, axis, m.volume.row(row)[index], t, opposite}, out, i);
      end_run(i);
      current = -1;
      continue;
    }
    if (owner != current) {
      end_run(i);
      current = owner;
      start = i;
      if (!out.present(owner)) {
        out.set_present(owner, true);
        double* f = out.flux(owner, 0);
        std::fill(f, f + out.faces(), 0.0);
      }
      flux = out.flux(owner, 0);
    }
    flux[i] = t;
  }
  end_run(faces.end);
}

template void volume_fluxes<2>(const Mesh<2>&, const Settings&, int, const Line&, int, FaceRow&);
template void volume_fluxes<3>(const Mesh<3>&, const Settings&, int, const Line&, int, FaceRow&);

} // namespace ballast::remap
