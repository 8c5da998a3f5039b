// Microseconds a cell-step of the whole step, and the share of the stream bandwidth it would need if
// every field were read and written once. Not a timed test: run it on a quiet machine.
//   ballast_bench [threads [case, 1 to 3]]
#include "ale/fill.hpp"
#include "ale/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace ballast;

Material ideal_gas() {
  Material m;
  m.name = "gas";
  m.eos = IdealGas{1.4};
  m.density = 1;
  m.specific_energy = 2.5;
  return m;
}

Material copper() {
  Material m;
  m.name = "copper";
  m.eos = MieGruneisen{8930, 3940, 1.489, 2.02};
  m.strength = LinearHardening{47.7e9, 120e6, 0};
  m.density = 8930;
  return m;
}

/// A box of n cells an axis, a smooth velocity field, closed.
template <int Dim> Scene<Dim> box(const Material& material, int n, double speed, MotionPolicy motion, int threads) {
  Scene<Dim> scene;
  scene.pool = std::make_unique<ThreadPool>(threads);
  scene.numerics.energy_return = !has_strength(material.strength);
  Block<Dim> b;
  b.motion = {motion, 1};
  b.materials.push_back(make_slot(material, 0));
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (int i = 0; i <= n; ++i) {
      lines[d].push_back(static_cast<double>(i) / n);
    }
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const CellPart part{0, 1, material.density, material.specific_energy};
    fill_cell<Dim>(b, i, j, k, std::span(&part, 1));
  });
  set_velocity(b, [&](const std::array<double, Dim>& x, std::array<double, Dim>& u) {
    for (std::size_t d = 0; d < Dim; ++d) {
      u[d] = speed * std::sin(3.14159265358979 * x[d]) * std::cos(3.14159265358979 * x[(d + 1) % Dim]);
    }
  });
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  return scene;
}

/// Median over five batches of steps, in us a cell-step.
template <int Dim> double measure(const Material& material, int n, double speed, MotionPolicy motion, int threads, int steps) {
  Scene<Dim> scene = box<Dim>(material, n, speed, motion, threads);
  Clock clock;
  clock.end_time = 1e30;
  std::vector<double> times;
  for (int batch = 0; batch < 6; ++batch) {
    const auto start = std::chrono::steady_clock::now();
    for (int s = 0; s < steps; ++s) {
      advance(scene, clock);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (batch > 0) {
      times.push_back(1e6 * seconds / (static_cast<double>(steps) * static_cast<double>(scene.blocks[0].grid.cell_count())));
    }
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// a = b + s c on arrays well beyond the caches, GB/s, one thread.
double triad() {
  const std::size_t n = 40'000'000;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 0;
  for (int pass = 0; pass < 5; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = b[i] + 3.0 * c[i];
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::max(best, 3.0 * sizeof(double) * static_cast<double>(n) / seconds * 1e-9);
    std::swap(a, b);
  }
  return best;
}

} // namespace

int main(int argc, char** argv) {
  ballast::keep_freed_memory();
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
  const int only = argc > 2 ? std::atoi(argv[2]) : 0;
  if (threads < 1 || only < 0 || only > 3) {
    std::fprintf(stderr, "usage: ballast_bench [threads, 1 or more [case, 1 to 3]]\n");
    return 2;
  }
  if (only == 0) {
    std::printf("%d thread(s), stream triad %.1f GB/s on one\n", threads, triad());
  }
  if (only == 0 || only == 1) {
    std::printf("3D Lagrangian gas, 64^3           %.3f us a cell-step (asked 0.25 on one core)\n",
                measure<3>(ideal_gas(), 64, 0.1, MotionPolicy::lagrangian, threads, 3));
  }
  if (only == 0 || only == 2) {
    std::printf("3D Eulerian copper, strength 64^3 %.3f us a cell-step (asked 0.70 on one core)\n",
                measure<3>(copper(), 64, 100, MotionPolicy::eulerian, threads, 2));
  }
  if (only == 0 || only == 3) {
    std::printf("2D Eulerian gas, 400^2            %.3f us a cell-step (asked 0.12 on one core)\n",
                measure<2>(ideal_gas(), 400, 0.1, MotionPolicy::eulerian, threads, 4));
  }
  return 0;
}
