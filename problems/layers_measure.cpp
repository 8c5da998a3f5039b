#include "problems/layers_measure.hpp"

#include "ale/layers/layer_rows.hpp"
#include "core/io/summary.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double dome_edge = 1e-3;      // m
constexpr double dome_edge_part = 0.05; // of the largest deflection

/// The line nearest to the shot line, where the coordinate is 0.
int middle_line(const std::vector<double>& lines) {
  const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return lines.empty() ? 0 : static_cast<int>(std::min_element(lines.begin(), lines.end(), nearer) - lines.begin());
}

template <int Dim> struct BackFace {
  const LayerStack<Dim>& s;
  double direction;
  int plane = direction > 0 ? s.grid.planes() - 1 : 0, level = direction > 0 ? s.grid.levels() - 1 : 0;

  double deflection(int i, int j) const {
    const std::size_t n = s.node(i, j, plane);
    return direction * (s.position[Dim - 1][n] - s.rest[Dim - 1][n]);
  }
  double velocity(int i, int j) const { return direction * s.velocity[Dim - 1][s.node(i, j, plane)]; }
  bool there(int i, int j) const {
    for (int jj = Dim == 3 ? std::max(0, j - 1) : 0; jj <= (Dim == 3 ? std::min(j, s.grid.elements[1] - 1) : 0); ++jj) {
      for (int ii = std::max(0, i - 1); ii <= std::min(i, s.grid.elements[0] - 1); ++ii) {
        if (s.alive[s.element(ii, jj, level)] != 0) {
          return true;
        }
      }
    }
    return false;
  }
};

template <int Dim> double largest_deflection(const BackFace<Dim>& face) {
  double largest = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < (Dim == 3 ? face.s.grid.nodes_along(1) : 1); ++j) {
    for (int i = 0; i < face.s.grid.nodes_along(0); ++i) {
      largest = face.there(i, j) ? std::max(largest, face.deflection(i, j)) : largest;
    }
  }
  return std::isfinite(largest) ? largest : 0.0; // all of it gone
}

template <int Dim> double eroded_mass(const LayerStack<Dim>& s) {
  double volume = 0;
  for (int level = 0; level < s.grid.levels(); ++level) {
    for (int j = 0; j < s.grid.elements[1]; ++j) {
      const RowSizes sizes = row_sizes(s, j, level);
      for (int i = 0; i < sizes.count; ++i) {
        volume += s.alive[s.element(i, j, level)] == 0 ? sizes.volume(i) : 0.0;
      }
    }
  }
  return s.density * volume;
}

template <int Dim> std::vector<std::string> axes_of(const LayerStack<Dim>& s) {
  return Dim == 3 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{s.axisymmetric ? "r" : "x"};
}

} // namespace

std::string column_name(const std::string& name) {
  std::string out = name;
  for (char& letter : out) {
    letter = letter == ',' || letter == '"' || letter == '\n' ? ' ' : letter;
  }
  return out;
}

template <int Dim> BackFaceLine back_face_line(const LayerStack<Dim>& s, double direction, int axis) {
  const BackFace<Dim> face{s, direction};
  const int i0 = middle_line(s.lines[0]), j0 = middle_line(s.lines[1]);
  BackFaceLine line;
  for (int k = axis == 0 ? i0 : j0; k < s.grid.nodes_along(axis); ++k) {
    const int i = axis == 0 ? k : i0, j = axis == 0 ? j0 : k;
    line.radius.push_back(s.lines[static_cast<std::size_t>(axis)][static_cast<std::size_t>(k)]);
    line.deflection.push_back(face.deflection(i, j));
    line.velocity.push_back(face.velocity(i, j));
    line.there.push_back(face.there(i, j) ? 1 : 0);
  }
  return line;
}

double dome_radius(const BackFaceLine& line, double threshold) {
  const auto above = [&](std::size_t k) { return line.there[k] != 0 && line.deflection[k] >= threshold; };
  for (std::size_t k = line.radius.size(); k-- > 0;) {
    if (!above(k)) {
      continue;
    }
    if (k + 1 == line.radius.size() || line.there[k + 1] == 0) {
      return line.radius[k];
    }
    const double fall = line.deflection[k] - line.deflection[k + 1];
    return line.radius[k] + (line.radius[k + 1] - line.radius[k]) * (line.deflection[k] - threshold) / fall;
  }
  return 0;
}

template <int Dim> double largest_back_face(const LayerStack<Dim>& s, double direction) { return largest_deflection(BackFace<Dim>{s, direction}); }

template <int Dim> LayerMeasure measure_layers(const LayerStack<Dim>& s, double direction) {
  const BackFace<Dim> face{s, direction};
  const int i0 = middle_line(s.lines[0]), j0 = middle_line(s.lines[1]);
  LayerMeasure m;
  m.centre = face.deflection(i0, j0);
  m.velocity = face.velocity(i0, j0);
  m.largest = largest_deflection(face);
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const BackFaceLine line = back_face_line(s, direction, axis);
    m.dome.push_back(dome_radius(line, dome_edge));
    m.dome_part.push_back(m.largest > 0 ? dome_radius(line, dome_edge_part * m.largest) : 0.0);
  }
  m.eroded_mass = eroded_mass(s);
  m.totals = totals(s);
  return m;
}

template <int Dim> std::vector<std::string> layer_columns(const LayerStack<Dim>& s) {
  std::vector<std::string> quantities = {"deflection [m]", "deflection_largest [m]", "deflection_velocity [m/s]"};
  for (const std::string& axis : axes_of(s)) {
    quantities.push_back(fmt::format("dome_radius_{} [m]", axis));
    quantities.push_back(fmt::format("dome_radius_{}_5_percent [m]", axis));
  }
  for (const char* q : {"eroded_mass [kg]", "momentum [kg m/s]", "energy_kinetic [J]", "energy_internal [J]", "energy_hourglass [J]", "energy_shock_heat [J]", "energy_edge [J]", "contact_loss [J]", "friction_loss [J]", "step_change [J]", "penetration_deepest [m]", "turned_over", "inside_without_contact"}) {
    quantities.emplace_back(q);
  }
  for (std::string& q : quantities) {
    q = fmt::format("{}_{}", column_name(s.name), q);
  }
  return quantities;
}

template <int Dim> std::vector<double> layer_values(const LayerStack<Dim>& s, const LayerLedger& ledger, double direction) {
  const LayerMeasure m = measure_layers(s, direction);
  std::vector<double> v = {m.centre, m.largest, m.velocity};
  for (std::size_t axis = 0; axis < m.dome.size(); ++axis) {
    v.push_back(m.dome[axis]);
    v.push_back(m.dome_part[axis]);
  }
  v.insert(v.end(), {m.eroded_mass, direction * m.totals.momentum[Dim - 1], m.totals.kinetic, m.totals.internal, m.totals.hourglass, m.totals.shock_heat, ledger.edge_work + ledger.edge_loss, ledger.contact_loss, ledger.friction_loss, ledger.step_change, ledger.deepest,
                      static_cast<double>(ledger.turned_over), static_cast<double>(ledger.behind)});
  return v;
}

template <int Dim> void write_back_face(const LayerStack<Dim>& s, double direction, const std::filesystem::path& path) {
  std::vector<BackFaceLine> lines;
  std::string text = "radius [m]";
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const std::string name = axes_of(s)[static_cast<std::size_t>(axis)];
    text += fmt::format(",deflection_{} [m],velocity_{} [m/s]", name, name);
    lines.push_back(back_face_line(s, direction, axis));
  }
  for (std::size_t k = 0; k < lines.front().radius.size(); ++k) {
    text += fmt::format("\n{:.17g}", lines.front().radius[k]);
    for (const BackFaceLine& line : lines) {
      text += line.there[k] != 0 ? fmt::format(",{:.17g},{:.17g}", line.deflection[k], line.velocity[k]) : std::string(",nan,nan");
    }
  }
  io::write_text_atomically(path, text + "\n");
}

std::filesystem::path back_face_file(const std::filesystem::path& dir, const std::string& name, std::size_t stacks, int index) {
  std::string safe = name;
  for (char& c : safe) {
    c = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ? c : '_';
  }
  return dir / (stacks > 1 ? fmt::format("back_face_{}_{:04d}.csv", safe, index) : fmt::format("back_face_{:04d}.csv", index));
}

template BackFaceLine back_face_line<2>(const LayerStack<2>&, double, int);
template BackFaceLine back_face_line<3>(const LayerStack<3>&, double, int);
template double largest_back_face<2>(const LayerStack<2>&, double);
template double largest_back_face<3>(const LayerStack<3>&, double);
template LayerMeasure measure_layers<2>(const LayerStack<2>&, double);
template LayerMeasure measure_layers<3>(const LayerStack<3>&, double);
template std::vector<std::string> layer_columns<2>(const LayerStack<2>&);
template std::vector<std::string> layer_columns<3>(const LayerStack<3>&);
template std::vector<double> layer_values<2>(const LayerStack<2>&, const LayerLedger&, double);
template std::vector<double> layer_values<3>(const LayerStack<3>&, const LayerLedger&, double);
template void write_back_face<2>(const LayerStack<2>&, double, const std::filesystem::path&);
template void write_back_face<3>(const LayerStack<3>&, double, const std::filesystem::path&);

} // namespace ballast
