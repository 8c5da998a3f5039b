// Microseconds an element-step of fabric layers without contact: forces, two kicks, drift and the choice of the step.
//   ballast_bench_layers [threads]
#include "ale/layers/layer_step.hpp"
#include "materials/fabric_library.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace ballast;

/// Least of `steps` steps of a waving square of n x n elements (2D: a strip of n) and `layers` layers.
template <int Dim> double measure(const char* fabric, int n, int layers, int threads, int steps) {
  LayerInput in;
  in.model = find_fabric(fabric)->model;
  in.lines[0] = even_lines(0, 1e-3 * n, n);
  if (Dim == 3) {
    in.lines[1] = in.lines[0];
  }
  in.layers = layers;
  in.levels = even_lines(0, 0.7e-3 * layers, layers);
  LayerStack<Dim> stack = make_stack<Dim>(in);
  for (std::size_t k = 0; k < stack.node_count(); ++k) {
    stack.velocity[Dim - 1][k] = 20 * std::sin(600 * stack.rest[0][k]);
  }
  ThreadPool pool(threads);
  LayerLedger ledger;
  update_forces(stack, 0.0, ledger, pool);
  double least = 1e300;
  for (int step = 0; step < steps; ++step) {
    const auto start = std::chrono::steady_clock::now();
    substep(stack, stable_step(stack).dt, ledger, pool);
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e6 * least / static_cast<double>(stack.element_count());
}

} // namespace

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
  if (threads < 1) {
    std::fprintf(stderr, "usage: ballast_bench_layers [threads, 1 or more]\n");
    return 2;
  }
  const char *printed = "kevlar_km2_raftenberg", *hooke = "kevlar_hooke_wstm";
  std::printf("layers, %d thread(s), us an element-step\n", threads);
  std::printf("3D printed law, 75 x 75 x 5   %.3f\n", measure<3>(printed, 75, 5, threads, 60));
  std::printf("3D Hooke, 75 x 75 x 5         %.3f\n", measure<3>(hooke, 75, 5, threads, 60));
  std::printf("3D printed law, 75 x 75 x 28  %.3f\n", measure<3>(printed, 75, 28, threads, 20));
  std::printf("2D printed law, 300 x 5       %.3f\n", measure<2>(printed, 300, 5, threads, 300));
  return 0;
}
