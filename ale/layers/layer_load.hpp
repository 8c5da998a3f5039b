// Load: what a mesh around a stack puts on its nodes during a step: forces that stay, and mass that moves with them.
//
// Added mass is a tensor A a node (along the normal of what clings to it): a = (m + A)^-1 (f + L). The stack's `force` becomes m a, so
// that its own step and account go on as ever; what that differs by from the elements' own force works on the stack: load_work.
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <Eigen/Core>

#include <algorithm>

namespace ballast {

template <int Dim> struct LayerLoad {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  std::vector<std::size_t> node; ///< each once, ascending
  std::vector<Vector> force;     ///< N
  std::vector<Matrix> added;     ///< kg
  std::vector<Vector> own;       ///< N: the elements' own force, where `force` of the stack is not it

  std::vector<Matrix> by_node;   ///< kg: `added` by node of the stack, as impulses look it up (spread); empty if none is loaded

  bool empty() const { return node.empty(); }
  /// Fills by_node from the lists.
  void spread(std::size_t node_count) {
    by_node.assign(node.empty() ? 0 : node_count, Matrix::Zero());
    for (std::size_t q = 0; q < node.size(); ++q) {
      by_node[node[q]] = added[q];
    }
  }
  /// Added mass of a node along a unit vector; none if it is not loaded.
  double mass_along(std::size_t n, const std::array<double, Dim>& along) const {
    const auto at = std::lower_bound(node.begin(), node.end(), n);
    if (at == node.end() || *at != n) {
      return 0;
    }
    const Vector v(along.data());
    return v.dot(added[static_cast<std::size_t>(at - node.begin())] * v);
  }
  /// Where a loaded node stands in the lists.
  std::size_t index_of(std::size_t n) const { return static_cast<std::size_t>(std::lower_bound(node.begin(), node.end(), n) - node.begin()); }
};

/// Change of velocity of a loaded node by an impulse (kg m/s): (m + A)^-1 impulse, none along held axes (bits).
template <int Dim> Eigen::Matrix<double, Dim, 1> pushed(double mass, const Eigen::Matrix<double, Dim, Dim>& added, const Eigen::Matrix<double, Dim, 1>& impulse, unsigned held);

/// Puts the load on: the stack's force becomes what its own masses feel. Keeps the elements' own.
template <int Dim> void put_on(LayerStack<Dim>& stack, LayerLoad<Dim>& load);

/// Takes it off again.
template <int Dim> void take_off(LayerStack<Dim>& stack, LayerLoad<Dim>& load);

/// A load put on before a step dt (s) changes the account's kinetic energy by the length of the step before, and step_change takes that back. Where the
/// load is new both entries would be far larger than what it does (a force of one short step after a long one): they are made those of dt. Their
/// difference stays.
template <int Dim> void book_new_force(const LayerStack<Dim>& stack, const LayerLoad<Dim>& load, double dt, LayerLedger& ledger);

/// Books the load's work on the stack over `half` (s) at the velocity.
template <int Dim> void book_load(const LayerStack<Dim>& stack, const LayerLoad<Dim>& load, double half, LayerLedger& ledger);

/// Kinetic energy (J) of the loaded nodes' own masses as the stack's account counts it (leapfrog_kinetic).
template <int Dim> double kinetic_of(const LayerStack<Dim>& stack, const LayerLoad<Dim>& load);

} // namespace ballast
