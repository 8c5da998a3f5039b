// Laws of the interface normal: exact planes, symmetry, order of convergence.
#include "remap/normal.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace ballast::remap {
namespace {

template <int Dim> using Stencil = std::array<double, stencil_size<Dim>>;

template <int Dim> std::array<int, Dim> offset_of(int index) {
  std::array<int, Dim> o;
  for (int d = 0; d < Dim; ++d, index /= 3)
    o[d] = index % 3 - 1;
  return o;
}

template <int Dim> int index_of(const std::array<int, Dim>& o) {
  int index = 0;
  for (int d = Dim - 1; d >= 0; --d)
    index = 3 * index + o[d] + 1;
  return index;
}

template <int Dim> Stencil<Dim> plane_stencil(const Normal<Dim>& n, double fraction) {
  const double alpha = plane_constant<Dim>(n, fraction);
  Stencil<Dim> f;
  for (int index = 0; index < stencil_size<Dim>; ++index) {
    const auto o = offset_of<Dim>(index);
    double shifted = alpha;
    for (int d = 0; d < Dim; ++d)
      shifted -= n[d] * o[d];
    f[index] = volume_below<Dim>(n, shifted);
  }
  return f;
}

template <int Dim> class Draw {
public:
  Normal<Dim> normal() {
    Normal<Dim> n;
    double square = 0.0;
    for (int d = 0; d < Dim; ++d)
      n[d] = gauss_(random_), square += n[d] * n[d];
    for (int d = 0; d < Dim; ++d)
      n[d] /= std::sqrt(square);
    return n;
  }
  double fraction() { return unit_(random_); }

private:
  std::mt19937 random_{2024};
  std::normal_distribution<double> gauss_;
  std::uniform_real_distribution<double> unit_{0.001, 0.999};
};

template <int Dim> double distance(const Normal<Dim>& a, const Normal<Dim>& b) {
  double square = 0.0;
  for (int d = 0; d < Dim; ++d)
    square += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(square);
}

Normal<3> plane_unit(const Normal<3>& n) {
  const double length = std::hypot(n[0], n[1], n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

TEST(Normal, ElviraIsExactForLines) {
  Draw<2> draw;
  for (int k = 0; k < 20000; ++k) {
    const Normal<2> n = draw.normal();
    const Stencil<2> f = plane_stencil<2>(n, draw.fraction());
    // A height difference carries ~1e-15; small centre fractions cost the fit a little more.
    ASSERT_LT(distance<2>(interface_normal<2>(NormalMethod::elvira, f.data()), n), 1e-12) << k;
  }
}

TEST(Normal, ElviraIsExactForPlanes) {
  Draw<3> draw;
  for (int k = 0; k < 20000; ++k) {
    const Normal<3> n = draw.normal();
    const Stencil<3> f = plane_stencil<3>(n, draw.fraction());
    ASSERT_LT(distance<3>(interface_normal<3>(NormalMethod::elvira, f.data()), n), 1e-12) << k;
  }
}

TEST(Normal, ElviraIsExactForPlanesAlongAnAxis) {
  Draw<2> draw;
  for (int k = 0; k < 6000; ++k) {
    const Normal<2> line = draw.normal();
    Normal<3> n{};
    n[k % 3] = line[0];
    n[(k + 1) % 3] = line[1];
    const Stencil<3> f = plane_stencil<3>(n, draw.fraction());
    ASSERT_LT(distance<3>(interface_normal<3>(NormalMethod::elvira, f.data()), n), 1e-12) << k;
  }
}

// Two equal components, where the order of axes is a matter of convention.
TEST(Normal, ElviraIsExactForDiagonalPlanes) {
  Draw<2> draw;
  for (int k = 0; k < 6000; ++k) {
    const Normal<2> line = draw.normal();
    Normal<3> n = {line[0], line[0], line[0]};
    n[k % 3] = line[1];
    const Stencil<3> f = plane_stencil<3>(n, draw.fraction());
    ASSERT_LT(distance<3>(interface_normal<3>(NormalMethod::elvira, f.data()), plane_unit(n)),
              1e-12)
        << k;
  }
}

TEST(Normal, AxisPlanesAreExactForEveryMethod) {
  for (const auto method :
       {NormalMethod::elvira, NormalMethod::mixed_youngs_centred, NormalMethod::youngs})
    for (int d = 0; d < 3; ++d) {
      Normal<3> n{};
      n[d] = d == 1 ? -1.0 : 1.0;
      EXPECT_EQ(interface_normal<3>(method, plane_stencil<3>(n, 0.3).data()), n);
    }
}

// A rough stencil with a gradient, so that nothing is exact and ties are rare.
template <int Dim> Stencil<Dim> rough_stencil(Draw<Dim>& draw) {
  Stencil<Dim> f = plane_stencil<Dim>(draw.normal(), draw.fraction());
  for (double& value : f)
    value = std::clamp(value + 0.1 * (draw.fraction() - 0.5), 0.0, 1.0);
  return f;
}

// Coarse values make equal differences, equal candidates and diagonal stencils common.
template <int Dim> Stencil<Dim> tied_stencil(Draw<Dim>& draw) {
  Stencil<Dim> f = plane_stencil<Dim>(draw.normal(), draw.fraction());
  for (double& value : f)
    value = std::round(4.0 * value) / 4.0;
  return f;
}

template <int Dim> Stencil<Dim> mirrored(const Stencil<Dim>& f, int axis) {
  Stencil<Dim> g;
  for (int index = 0; index < stencil_size<Dim>; ++index) {
    auto o = offset_of<Dim>(index);
    o[axis] = -o[axis];
    g[index_of<Dim>(o)] = f[index];
  }
  return g;
}

template <int Dim> Stencil<Dim> swapped(const Stencil<Dim>& f, int a, int b) {
  Stencil<Dim> g;
  for (int index = 0; index < stencil_size<Dim>; ++index) {
    auto o = offset_of<Dim>(index);
    std::swap(o[a], o[b]);
    g[index_of<Dim>(o)] = f[index];
  }
  return g;
}

template <int Dim> void expect_symmetric(NormalMethod method, const Stencil<Dim>& f) {
  const Normal<Dim> n = interface_normal<Dim>(method, f.data());
  for (int axis = 0; axis < Dim; ++axis) {
    Normal<Dim> expected = n;
    expected[axis] = -n[axis];
    ASSERT_EQ(interface_normal<Dim>(method, mirrored<Dim>(f, axis).data()), expected);
    const int other = (axis + 1) % Dim;
    expected = n;
    std::swap(expected[axis], expected[other]);
    ASSERT_EQ(interface_normal<Dim>(method, swapped<Dim>(f, axis, other).data()), expected);
  }
}

template <int Dim> void expect_symmetric_methods() {
  for (const auto method :
       {NormalMethod::elvira, NormalMethod::mixed_youngs_centred, NormalMethod::youngs}) {
    Draw<Dim> draw;
    for (int k = 0; k < 3000; ++k) {
      expect_symmetric<Dim>(method, rough_stencil<Dim>(draw));
      const Stencil<Dim> coarse = tied_stencil<Dim>(draw);
      const Normal<Dim> n = interface_normal<Dim>(NormalMethod::youngs, coarse.data());
      if (distance<Dim>(n, {1.0}) > 0.0)
        expect_symmetric<Dim>(method, coarse);
      if (testing::Test::HasFatalFailure())
        return;
    }
  }
}

TEST(Normal, MirrorAndSwapAreBitwiseIn2D) {
  expect_symmetric_methods<2>();
}
TEST(Normal, MirrorAndSwapAreBitwiseIn3D) {
  expect_symmetric_methods<3>();
}

TEST(Normal, SwapSymmetricStencilGivesDiagonal) {
  Stencil<2> f = {1.0, 1.0, 0.6, 1.0, 0.7, 0.1, 0.6, 0.1, 0.0};
  const Normal<2> n = interface_normal<2>(NormalMethod::elvira, f.data());
  EXPECT_EQ(n[0], n[1]);
  EXPECT_GT(n[0], 0.0);
}

TEST(Normal, NoGradientGivesFirstAxis) {
  Stencil<2> flat;
  flat.fill(0.4);
  Stencil<3> drop{};
  drop[13] = 0.5;
  for (const auto method :
       {NormalMethod::elvira, NormalMethod::mixed_youngs_centred, NormalMethod::youngs}) {
    EXPECT_EQ(interface_normal<2>(method, flat.data()), (Normal<2>{1.0, 0.0}));
    EXPECT_EQ(interface_normal<3>(method, drop.data()), (Normal<3>{1.0, 0.0, 0.0}));
  }
}

// Fraction of the cell of width h at corner c inside |x| <= radius, by midpoint rule along the last
// axes and exactly along the first.
double sphere_fraction(const std::array<double, 3>& c, double h, double radius) {
  constexpr int points = 24;
  double sum = 0.0;
  for (int a = 0; a < points; ++a)
    for (int b = 0; b < points; ++b) {
      const double y = c[1] + h * (a + 0.5) / points, z = c[2] + h * (b + 0.5) / points;
      const double square = radius * radius - y * y - z * z;
      if (square <= 0.0)
        continue;
      const double reach = std::sqrt(square);
      sum += std::max(0.0, std::min(c[0] + h, reach) - std::max(c[0], -reach));
    }
  return sum / (h * points * points);
}

// Largest angle between the normal and the sphere's own at random points.
double worst_sphere_angle(NormalMethod method, double h) {
  Draw<3> draw;
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const Normal<3> exact = draw.normal();
    Stencil<3> f;
    for (int index = 0; index < 27; ++index) {
      const auto o = offset_of<3>(index);
      f[index] = sphere_fraction(
          {exact[0] + (o[0] - 0.5) * h, exact[1] + (o[1] - 0.5) * h, exact[2] + (o[2] - 0.5) * h},
          h,
          1.0);
    }
    worst = std::max(worst, distance<3>(interface_normal<3>(method, f.data()), exact));
  }
  return worst;
}

TEST(Normal, ElviraConvergesOnASphere) {
  const double coarse = worst_sphere_angle(NormalMethod::elvira, 0.1);
  const double fine = worst_sphere_angle(NormalMethod::elvira, 0.05);
  EXPECT_LT(fine, 0.05);                    // one cell turns the normal by h / R
  EXPECT_GT(std::log2(coarse / fine), 0.8); // first order at least in the normal
}

} // namespace
} // namespace ballast::remap
