// Pieces of a remap sweep, private to remap/.
#pragma once

#include "remap/mesh.hpp"

namespace ballast::remap {

/// Axis of sweep number q (0 .. dim - 1): i, j, k or the reverse.
inline int sweep_axis(int dim, int q, long order) {
  return order % 2 == 0 ? q : dim - 1 - q;
}

template <int Dim>
void compute_swept(Mesh<Dim>& mesh, ThreadPool& pool, const std::array<RowField, Dim>& from, const std::array<RowField, Dim>& to, long order);

/// Allocates tiles that a sweep may reach and fills every ghost a sweep along `axis` reads.
template <int Dim> void exchange_for_sweep(Mesh<Dim>& mesh, ThreadPool& pool, int axis);

/// Cells' part of a sweep along `axis`: volumes, fractions, masses, intensives; leaves mass_flux and the cells'
/// masses before the sweep in scratch.cell_mass.
template <int Dim>
void sweep_cells(Mesh<Dim>& mesh, const Settings& settings, ThreadPool& pool, int axis, Report& report);

/// Nodes' part: momentum on the dual mesh with the cells' mass fluxes. Kinetic energy lost is added up by node
/// in scratch.node_loss, from zero at the `first` sweep (sliding: part_sliding zeroes it).
template <int Dim>
void sweep_nodes(Mesh<Dim>& mesh, const Settings& settings, ThreadPool& pool, int axis, bool first, Report& report);

/// Before the sweeps: the node's mass and velocity become those of what does not slide, sliding.velocity that of what
/// does; the losses by node start at zero.
template <int Dim> void part_sliding(Mesh<Dim>& mesh, ThreadPool& pool);

/// After them: across the interface both move as one, along it each keeps its velocity. The energy of that impact is
/// loss and becomes heat of what slides.
template <int Dim> void join_sliding(Mesh<Dim>& mesh, ThreadPool& pool, Report& report);

/// Gives every node's loss to its cells by corner mass, every cell's to its materials by mass.
template <int Dim> void return_kinetic(Mesh<Dim>& mesh, ThreadPool& pool, Report& report);

} // namespace ballast::remap
