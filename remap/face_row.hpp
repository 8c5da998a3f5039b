// Fluxes of everything through one row of faces.
#pragma once

#include "remap/flux_rows.hpp"
#include "remap/mesh.hpp"

#include <vector>

namespace ballast::remap {

/// Fluxes through one row of faces, per material and conserved field; zero where a material has none.
class FaceRow {
public:
  template <int Dim> FaceRow(const Mesh<Dim>& m, int faces) : faces_(faces) {
    int fields = 0;
    for (const TileStore* s : m.materials) {
      first_.push_back(fields);
      fields += s->conserved();
    }
    data_.assign(static_cast<std::size_t>(fields * faces), 0.0);
    present_.assign(m.materials.size(), false);
    crossed_.assign(m.materials.size(), Span{});
  }
  double* flux(int material, int field) {
    return data_.data() + (first_[static_cast<std::size_t>(material)] + field) * faces_;
  }
  bool present(int material) const { return present_[static_cast<std::size_t>(material)]; }
  void set_present(int material, bool p) {
    present_[static_cast<std::size_t>(material)] = p;
    crossed_[static_cast<std::size_t>(material)] = {};
  }
  /// The faces that some of the material crosses lie in this run.
  const Span& crossed(int material) const { return crossed_[static_cast<std::size_t>(material)]; }
  void cross(int material, const Span& faces) {
    Span& s = crossed_[static_cast<std::size_t>(material)];
    s = hull(s, faces);
  }
  int faces() const { return faces_; }
  /// The only material of the cells on both sides of all faces, or -1.
  int sole = -1;

private:
  int faces_;
  std::vector<int> first_;
  std::vector<char> present_;
  std::vector<Span> crossed_;
  std::vector<double> data_;
};

/// Material volumes (m3, along +axis) through the row of faces below the cells of row `r_faces`; i of face 0 is cell
/// index 0. A pure donor gives its material, a mixed one slabs of its reconstruction.
template <int Dim>
void volume_fluxes(const Mesh<Dim>& mesh, const Settings& settings, int axis, const Line& line, int r_faces, FaceRow& out);

} // namespace ballast::remap
