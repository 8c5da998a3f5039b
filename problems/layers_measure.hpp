// What a run reports of a stack of fabric layers: the deflection of its back face, and its books.
//
// The back face is the face of the stack away from the shot: the last plane of nodes of its last layer. Deflection is the displacement
// of its nodes along the shot, from rest; radii are those at rest, m. Nodes whose elements have all eroded fly on and are no face any
// more; only `centre`, the node on the shot line, is followed on.
#pragma once

#include "ale/layers/layer_step.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ballast {

/// Deflection (m) and velocity along the shot (m/s) of the back face's nodes on a line from the shot line out along one axis.
struct BackFaceLine {
  std::vector<double> radius, deflection, velocity;
  std::vector<char> there; ///< 0: all elements of the node have eroded
};

/// `axis` in the plane. `direction`: of the shot along the last axis, +1 or -1.
template <int Dim> BackFaceLine back_face_line(const LayerStack<Dim>& stack, double direction, int axis);

/// Where the deflection falls below `threshold` for good on the way out, linear between nodes; 0: nowhere above it.
double dome_radius(const BackFaceLine& line, double threshold);

struct LayerMeasure {
  double centre = 0;  ///< deflection on the shot line, m
  double largest = 0; ///< of all nodes of the back face
  double velocity = 0; ///< on the shot line along the shot, m/s
  std::vector<double> dome;      ///< along each axis in the plane: where the deflection falls below 1 mm
  std::vector<double> dome_part; ///< below 5 % of the largest
  double eroded_mass = 0;        ///< kg (planar: kg/m)
  LayerTotals totals;
};

/// Largest deflection of any node of the back face, m; without the sums of measure_layers.
template <int Dim> double largest_back_face(const LayerStack<Dim>& stack, double direction);
/// All of it.
template <int Dim> LayerMeasure measure_layers(const LayerStack<Dim>& stack, double direction);

/// A stack's name as it stands in columns.
std::string column_name(const std::string& name);

/// Columns of history.csv of a stack, "vest_deflection [m]" ..., and their values.
template <int Dim> std::vector<std::string> layer_columns(const LayerStack<Dim>& stack);
template <int Dim> std::vector<double> layer_values(const LayerStack<Dim>& stack, const LayerLedger& ledger, double direction);

/// The back face over the radius at one time as CSV: radius, then deflection and velocity along each axis in the plane; nan where
/// it has eroded. Throws Error if it cannot be written.
template <int Dim> void write_back_face(const LayerStack<Dim>& stack, double direction, const std::filesystem::path& path);

/// dir/back_face_0012.csv, of several stacks dir/back_face_NAME_0012.csv. `index`: of the dump.
std::filesystem::path back_face_file(const std::filesystem::path& dir, const std::string& name, std::size_t stacks, int index);

} // namespace ballast
