#include "materials/visco.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

Sym tensor_of(std::span<const double> state, std::size_t first) {
  return {state[first], state[first + 1], state[first + 2], state[first + 3], state[first + 4], state[first + 5]};
}
void set_tensor(std::span<double> state, std::size_t first, const Sym& s) { std::copy(s.begin(), s.end(), state.begin() + static_cast<std::ptrdiff_t>(first)); }

/// Springs in parallel: the long-term one, then those of the branches.
template <class Law> void strain_springs(const Law& m, const Sym& strain, std::span<double> state) {
  set_tensor(state, 0, combine(1, tensor_of(state, 0), 2 * m.long_shear, strain));
  for (std::size_t b = 0; b < m.branches; ++b) {
    set_tensor(state, 6 * (b + 1), combine(1, tensor_of(state, 6 * (b + 1)), 2 * m.branch[b].shear, strain));
  }
}

void strain_one(const Prony& m, const Sym& strain, std::span<double> state) { strain_springs(m, strain, state); }
void strain_one(const PowerLawZener& m, const Sym& strain, std::span<double> state) { strain_springs(m, strain, state); }
/// s_e is stiffer by exp(a e:e).
void strain_one(const FungQlv& m, const Sym& strain, std::span<double> state) {
  const Sym e = tensor_of(state, 0);
  set_tensor(state, 0, combine(1, e, std::exp(-m.stiffening * contract(e, e)), strain));
}
/// Where chains are long a strain counts for more.
void strain_one(const BergstroemBoyce&, const Sym& strain, std::span<double> state) {
  const double longest = std::max(trace(tensor_of(state, 0)), trace(tensor_of(state, 6)));
  Mat f = full(scaled(3 / std::max(3.0, longest), strain));
  for (const std::size_t a : {0, 4, 8}) {
    f[a] += 1;
  }
  for (const std::size_t first : {0, 6}) {
    set_tensor(state, first, push(f, tensor_of(state, first)));
  }
}

} // namespace

void strain_at_once(const TissueLaw& law, const Sym& strain, std::span<double> state) {
  std::visit([&](const auto& m) { strain_one(m, strain, state); }, law);
}

} // namespace ballast
