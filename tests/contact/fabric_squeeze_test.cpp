// Stacks of cloth, printed law and the element that carries it, crumpled and squeezed between plates: layers stay apart and right side out.
#include "ale/layers/slideline.hpp"
#include "tests/contact/sheets.hpp"
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double thickness = 6.67e-3, width = 16e-3; // m

struct Squeezed {
  double deepest = 0, left = 1; ///< of a layer; of the thickness
  long turned_over = 0, behind = 0, crushed = 0;
};

/// The upper plate comes down by `share` of the thickness, bent, while the layers slide on each other, ripple and are pushed in from their edges.
template <int Dim> Squeezed squeeze(int n, int layers, double share, double speed) {
  LayerStack<Dim> s = make_stack<Dim>(stacks::brick(fabric_laws::paper(), {n, n, layers}, {width / n, width / n, thickness / layers}, Dim));
  stacks::place(s, s.velocity, [&](std::array<double, Dim> X) {
    const auto layer = static_cast<std::size_t>(std::min(layers - 1, static_cast<int>(X[Dim - 1] / thickness * layers + 0.5)));
    std::array<double, Dim> v = {};
    for (std::size_t d = 0; d + 1 < Dim; ++d) {
      v[d] = -0.3 * speed * (2 * X[d] / width - 1) + 0.1 * speed * (layer % 2 == 0 ? 1 : -1);
    }
    v[Dim - 1] = 0.2 * speed * scatter(static_cast<std::size_t>(X[0] / width * n + 0.5) + 31 * layer);
    return v;
  });
  ThreadPool pool(2);
  LayerLedger ledger;
  SlidelineState<Dim> slidelines;
  Squeezed out;
  update_forces(s, 0.0, ledger, pool);
  const std::size_t plane = s.node_count() / static_cast<std::size_t>(s.grid.planes()), top = s.node_count() - plane;
  for (double t = 0; t * speed < share * thickness;) {
    const double dt = std::min(stable_step(s).dt, 0.02 * thickness / layers / speed);
    substep<Dim>(s, dt, ledger, pool, [&] {
      for (std::size_t k = 0; k < plane; ++k) {
        const double bent = std::sin(300 * s.rest[0][k]);
        s.velocity[Dim - 1][k] = 0;
        s.velocity[Dim - 1][top + k] = -speed * (1 - 0.2 * bent * bent);
      }
      const SlidelineReport r = resolve_slidelines(s, dt, s.velocity, pool, {}, slidelines);
      out.deepest = std::max(out.deepest, r.contact.deepest * layers / thickness);
      out.behind += r.contact.behind;
    });
    t += dt;
  }
  out.turned_over = ledger.turned_over;
  out.crushed = ledger.crushed;
  for (std::size_t k = 0; k < plane; ++k) {
    out.left = std::min(out.left, (s.position[Dim - 1][top + k] - s.position[Dim - 1][k]) / thickness);
  }
  return out;
}

template <int Dim> void expect_apart(int n, int layers, double share, double allowed) {
  const Squeezed q = squeeze<Dim>(n, layers, share, 100);
  EXPECT_LT(q.deepest, allowed) << Dim << "D, " << layers << " layers";
  EXPECT_LT(q.left, 1.01 - share);
  EXPECT_EQ(q.turned_over, 0);
}

// It ends, with at most 1 % of a layer inside its neighbour (5 % for 29 layers). Of 10 and 29 layers squeezed to a tenth, where the printed law presses with 100 GPa,
// some meshes let nodes in past the edges: up to 11 and 14 % of a layer in two of five (5 layers 0.3 % in all).
TEST(FabricSqueeze, CrumpledLayersStayApart) {
  expect_apart<2>(16, 2, 0.9, 0.01);
  expect_apart<2>(12, 5, 0.9, 0.01);
  expect_apart<2>(16, 5, 0.9, 0.01);
  expect_apart<2>(12, 10, 0.8, 0.01);
  expect_apart<2>(8, 29, 0.8, 0.05);
}

// In 3D to a quarter. Further on nodes that came in past the edges of elements fifteen times as wide as a layer is then thick are found inside: up to half a layer at a tenth.
TEST(FabricSqueeze, CrumpledLayersStayApartIn3D) {
  expect_apart<3>(8, 2, 0.75, 0.01);
  expect_apart<3>(8, 5, 0.75, 0.01);
}

} // namespace
} // namespace ballast
