#include "tests/verify/tube.hpp"


#include "materials/library.hpp"
#include "tests/verify/trial.hpp"

#include <algorithm>
#include <cmath>

namespace ballast::verify {

Material copper_at_zero() {
  Material m = *find_material("copper_ofhc");
  m.specific_energy = energy(m.eos, m.density, 0);
  return m;
}

template <int Dim> TubeRun<Dim> make_tube(const Tube& t) {
  TubeRun<Dim> run;
  Block<Dim> b;
  b.motion = {t.motion, t.remap_every};
  b.reference_pressure = t.reference_pressure;
  const bool one = t.materials[0].name == t.materials[1].name;
  b.materials.push_back(make_slot(t.materials[0], t.reference_pressure));
  if (!one) {
    b.materials.push_back(make_slot(t.materials[1], t.reference_pressure));
  }
  std::array<std::vector<double>, 3> lines;
  const double h = t.length / t.cells;
  for (std::size_t d = 0; d < Dim; ++d) {
    lines[d] = {0, h};
  }
  auto& line = lines[static_cast<std::size_t>(t.axis)];
  line.clear();
  double shift = 0;
  if (t.interface_in_cell) {
    const int cell = static_cast<int>(std::lround(t.interface / h - 0.5));
    shift = t.interface - (cell + 0.5) * h;
  }
  for (int i = 0; i <= t.cells; ++i) {
    line.push_back(i == 0 ? 0 : i == t.cells ? t.length : i * h + shift);
  }
  if (!t.lines.empty()) {
    line = t.lines;
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const int index[3] = {i, j, k};
    const auto c = static_cast<std::size_t>(index[t.axis]);
    const double f = std::clamp((t.interface - line[c]) / (line[c + 1] - line[c]), 0.0, 1.0);
    if (one) {
      const TubeState& s = f > 0.5 ? t.left : t.right;
      fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, 1, s.density, s.specific_energy}});
      return;
    }
    const bool left = f > 1 - 1e-9, right = f < 1e-9;
    fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, left ? 1 : right ? 0 : f, t.left.density, t.left.specific_energy},
                               {1, left ? 0 : right ? 1 : 1 - f, t.right.density, t.right.specific_energy}});
  });
  const auto a = static_cast<std::size_t>(t.axis);
  set_velocity(b, [&](const std::array<double, Dim>& x, std::array<double, Dim>& u) {
    const double tiny = 1e-9 * h;
    const bool between = std::abs(x[a] - t.interface) < tiny;
    const double l = t.left.density, r = t.right.density;
    u[a] = between ? (l * t.left.velocity + r * t.right.velocity) / (l + r)
                   : x[a] < t.interface ? t.left.velocity : t.right.velocity;
    for (int s = 0; t.ends && s < 2; ++s) {
      const BoundarySide& end = (*t.ends)[static_cast<std::size_t>(s)];
      if ((end.kind == BoundaryKind::wall || end.kind == BoundaryKind::inflow) && std::abs(x[a] - s * t.length) < tiny) {
        u[a] = end.velocity;
      }
    }
  });
  b.boundary.side[a] = t.ends.value_or(std::array<BoundarySide, 2>{
      BoundarySide{BoundaryKind::wall, t.left.velocity}, BoundarySide{BoundaryKind::wall, t.right.velocity}});
  for (std::size_t s = 0; s < 2; ++s) {
    if (b.boundary.side[a][s].kind == BoundaryKind::inflow) {
      const TubeState& state = s == 0 ? t.left : t.right;
      InflowState in{one ? 0 : static_cast<int>(s), state.density, state.specific_energy, {}};
      in.velocity[a] = b.boundary.side[a][s].velocity;
      b.boundary.side[a][s] = inflow_side(t.axis, in);
    }
  }
  run.scene.numerics = t.numerics;
  run.scene.pool = std::make_unique<ThreadPool>(t.threads);
  run.scene.blocks.push_back(std::move(b));
  run.clock.end_time = t.end_time;
  prepare(run.scene);
  run.start = totals(run.scene.blocks[0]);
  return run;
}

template <int Dim> TubeRun<Dim> run_tube(const Tube& tube) {
  TubeRun<Dim> r = make_tube<Dim>(tube);
  go(r.scene, r.clock);
  r.end = totals(r.scene.blocks[0]);
  return r;
}

template <int Dim> std::vector<TubeCell> profile(const Block<Dim>& b, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  std::vector<TubeCell> out;
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k), n0 = b.grid.node_row(j, k), n1 = n0 + b.grid.node_row_stride(axis);
    const int s = axis == 0 ? 1 : 0;
    const double x0 = b.position[a].row(n0)[i], x1 = b.position[a].row(n1)[i + s];
    const double u = 0.5 * (b.velocity[a].row(n0)[i] + b.velocity[a].row(n1)[i + s]);
    out.push_back({0.5 * (x0 + x1), x1 - x0, b.density.row(r)[i], u,
                   b.pressure.row(r)[i] + b.reference_pressure, b.owner_row(r)[i] < 0,
                   b.any_strength() && axis < 2 ? b.stress[a].row(r)[i] : 0.0});
  });
  return out;
}

TubeError error_against(const std::vector<TubeCell>& cells, const exact::Riemann& exact, double x0, double t) {
  TubeError e;
  for (const TubeCell& c : cells) {
    if (c.mixed) {
      continue;
    }
    const auto s = exact.at((c.centre - x0) / t);
    e.density += std::abs(c.density - s.density) * c.width;
    e.velocity += std::abs(c.velocity - s.velocity) * c.width;
    e.pressure += std::abs(c.pressure - s.pressure) * c.width;
  }
  return e;
}

Material gas(const std::string& name, const exact::GasState& s) {
  Material m;
  m.name = name;
  if (s.p_infinity == 0) {
    m.eos = IdealGas{s.gamma};
  } else {
    m.eos = StiffenedGas{s.gamma, s.p_infinity};
  }
  m.density = s.density;
  m.specific_energy = energy(m.eos, s.density, s.pressure);
  return m;
}

Tube riemann_tube(const exact::GasState& left, const exact::GasState& right, double x0, double t, int cells) {
  Tube tube;
  tube.cells = cells;
  tube.interface = x0;
  tube.end_time = t;
  const bool same = left.gamma == right.gamma && left.p_infinity == right.p_infinity;
  tube.materials = {gas("left", left), gas(same ? "left" : "right", right)};
  tube.left = {0, left.density, left.velocity, tube.materials[0].specific_energy};
  tube.right = {1, right.density, right.velocity, tube.materials[1].specific_energy};
  return tube;
}

template <int Dim> Conservation conservation(const TubeRun<Dim>& run) {
  Conservation c;
  const Ledger& l = run.scene.ledger;
  const double e0 = run.start.internal() + run.start.kinetic_energy;
  const double e1 = run.end.internal() + run.end.kinetic_energy;
  const bool returned = run.scene.numerics.energy_return;
  const double known = l.boundary_work + l.ambient_work + l.void_work - l.energy_out - l.sliver_energy -
                       (returned ? 0 : l.remap_kinetic_loss);
  const double energy = std::max(std::abs(e0), std::abs(e1)) + std::abs(l.boundary_work) + std::abs(l.energy_out);
  c.energy = std::abs(e1 - e0 - known) / energy;
  c.unreturned = returned ? std::abs(l.remap_kinetic_loss) / energy : 0;
  for (std::size_t m = 0; m < run.start.mass.size(); ++m) {
    if (run.start.mass[m] > 0) {
      c.mass = std::max(c.mass, std::abs(run.end.mass[m] + l.mass_out[m] - run.start.mass[m]) / run.start.mass[m]);
    }
  }
  double scale = 0;
  for (double m : run.start.mass) {
    scale += m;
  }
  scale *= std::sqrt(2 * std::max(run.start.kinetic_energy, run.end.kinetic_energy) / scale) + 1e-300;
  // Around an axis the radial momentum is no conserved quantity.
  for (std::size_t d = run.scene.blocks[0].axisymmetric ? 1 : 0; d < 3; ++d) {
    const double change = run.end.momentum[d] + l.momentum_out[d] - run.start.momentum[d];
    c.momentum = std::max(c.momentum, std::abs(change) / scale);
  }
  return c;
}

template TubeRun<2> make_tube<2>(const Tube&);
template TubeRun<3> make_tube<3>(const Tube&);
template TubeRun<2> run_tube<2>(const Tube&);
template TubeRun<3> run_tube<3>(const Tube&);
template std::vector<TubeCell> profile<2>(const Block<2>&, int);
template std::vector<TubeCell> profile<3>(const Block<3>&, int);
template Conservation conservation<2>(const TubeRun<2>&);
template Conservation conservation<3>(const TubeRun<3>&);

} // namespace ballast::verify
