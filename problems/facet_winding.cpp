#include "problems/facet_winding.hpp"

#include "problems/facet_tree.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace ballast {
namespace {

/// Where a line along an axis passes a facet: into the solid (+1) or out of it (-1).
struct Passage {
  double at;
  int step;
};

class LineWinding {
public:
  explicit LineWinding(const FacetMesh& mesh) : mesh_(mesh), tree_(mesh) {
    box_ = {mesh.vertices.front(), mesh.vertices.front()};
    for (const Point& p : mesh.vertices) {
      for (std::size_t k = 0; k < 3; ++k) {
        box_.lo[k] = std::min(box_.lo[k], p[k]);
        box_.hi[k] = std::max(box_.hi[k], p[k]);
      }
    }
    const Point size = box_.hi - box_.lo;
    rounding_ = 1e-9 * std::sqrt(dot(size, size));
  }
  const Bounds& box() const { return box_; }

  /// The flaw on the line through p along axis k; none, too, where the line meets the rim of a facet.
  std::string flaw(const Point& p, std::size_t k) {
    Point lo = p, hi = p;
    lo[k] = box_.lo[k];
    hi[k] = box_.hi[k];
    near_.clear();
    tree_.collect(lo, hi, near_);
    passages_.clear();
    for (const int i : near_) {
      if (!pass(mesh_.corners(static_cast<std::size_t>(i)), p, k)) {
        return "";
      }
    }
    std::sort(passages_.begin(), passages_.end(), [](const Passage& a, const Passage& b) { return a.at < b.at; });
    int winding = 0;
    for (std::size_t i = 0; i + 1 < passages_.size(); ++i) {
      winding += passages_[i].step;
      const double from = passages_[i].at, to = passages_[i + 1].at;
      if (winding != 0 && winding != 1 && to - from > rounding_) {
        Point q = p;
        q[k] = 0.5 * (from + to);
        const std::string place = fmt::format("({:g}, {:g}, {:g}) m", q[0], q[1], q[2]);
        return winding > 1 ? fmt::format("the facets enclose {} {} times: solids that overlap or lie in each other", place, winding)
                           : fmt::format("the facets face away from {}: a cavity that lies in no solid", place);
      }
    }
    return "";
  }

private:
  /// Adds the passage through a facet, if there is one; false: within rounding of its rim.
  bool pass(const Facet& f, const Point& p, std::size_t k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    std::array<double, 3> w{};
    double whole = 0, size2 = 0;
    for (std::size_t q = 0; q < 3; ++q) {
      const Point &a = f[(q + 1) % 3], &b = f[(q + 2) % 3];
      w[q] = (a[i] - p[i]) * (b[j] - p[j]) - (a[j] - p[j]) * (b[i] - p[i]);
      whole += w[q];
      size2 = std::max({size2, (a[i] - b[i]) * (a[i] - b[i]), (a[j] - b[j]) * (a[j] - b[j])});
    }
    const double slack = 1e-12 * size2;
    const bool up = std::all_of(w.begin(), w.end(), [&](double x) { return x > slack; });
    const bool down = std::all_of(w.begin(), w.end(), [&](double x) { return x < -slack; });
    if (up || down) { // seen along the line its corners run round against the clock: it faces along it
      passages_.push_back({(w[0] * f[0][k] + w[1] * f[1][k] + w[2] * f[2][k]) / whole, up ? -1 : 1});
      return true;
    }
    return std::any_of(w.begin(), w.end(), [&](double x) { return x > slack; }) && std::any_of(w.begin(), w.end(), [&](double x) { return x < -slack; });
  }

  const FacetMesh& mesh_;
  FacetTree tree_;
  Bounds box_;
  double rounding_ = 0;
  std::vector<int> near_;
  std::vector<Passage> passages_;
};

/// The axis a facet is most square to.
std::size_t square_to(const Facet& f) {
  const Point n = cross(f[1] - f[0], f[2] - f[0]);
  const auto most = std::max_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<std::size_t>(most - n.begin());
}

} // namespace

std::string shared_space(const FacetMesh& mesh) {
  LineWinding lines(mesh);
  constexpr std::size_t most_facets = 20000;
  constexpr std::array<Point, 4> shares = {{{0.9731, 0.0147, 0.0122}, {0.0127, 0.9719, 0.0154}, {0.0139, 0.0116, 0.9745}, {0.3413, 0.3217, 0.337}}};
  const std::size_t count = std::min(most_facets, mesh.facets.size());
  for (std::size_t q = 0; q < count; ++q) {
    const Facet f = mesh.corners(q * mesh.facets.size() / count);
    for (const Point& share : shares) {
      Point p{};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = share[0] * f[0][k] + share[1] * f[1][k] + share[2] * f[2][k];
      }
      if (const std::string flaw = lines.flaw(p, square_to(f)); !flaw.empty()) {
        return flaw;
      }
    }
  }
  constexpr int spread = 1000;
  constexpr std::array<double, 3> steps = {0.8191725134, 0.6710436067, 0.5497004779}; // powers of 1 / 1.2207: points that never line up
  const Point size = lines.box().hi - lines.box().lo;
  for (int n = 1; n <= spread; ++n) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = lines.box().lo[k] + size[k] * std::fmod(n * steps[k], 1.0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (const std::string flaw = lines.flaw(p, k); !flaw.empty()) {
        return flaw;
      }
    }
  }
  return "";
}

} // namespace ballast
