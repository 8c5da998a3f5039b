#include "ale/closure.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

constexpr double largest_part = 0.5; // of its volume that a material may lose to relaxation in one step

MixedCell::Part* void_part(MixedCell& cell) {
  MixedCell::Part* last = cell.count > 0 ? &cell.part[cell.count - 1] : nullptr;
  return last && last->is_void && last->volume > 0 ? last : nullptr;
}

/// Share of its volume that a material gives up where its first modulus says x. It stiffens as it goes, as
/// liquids do (Murnaghan, K' = 7): by its first modulus a trace of tissue beside metal at 8 GPa would end at 150.
double yields(double x) {
  constexpr double stiffening = 7, linear = 0.02; // K'; of its volume, to where results do not tell
  return x <= linear ? x : linear + (1 - linear) * (1 - std::pow(1 + stiffening * (x - linear) / (1 - linear), -1 / stiffening));
}

/// No material changes its volume by more than largest_part of it in a step, and what has the less of the compliance shrinks as it
/// stiffens (a gas that has most of it must yield first): what a soft one cannot take, the others take by compliance. A capped one does the work of its own mean pressure,
/// p - K/2 dV/V; the others take the rest, so volume and energy still sum exactly.
void cap_changes(MixedCell& cell) {
  bool capped[max_materials_in_cell] = {};
  double soft = 0; // m3/Pa, all of it
  for (int k = 0; k < cell.count; ++k) {
    soft += cell.part[k].is_void ? 0 : cell.part[k].volume / cell.part[k].modulus;
  }
  const auto may_change = [&](const MixedCell::Part& p) {
    const bool stiffens = p.volume_change < 0 && p.volume / p.modulus < 0.5 * soft;
    return p.volume * (stiffens ? std::min(yields(-p.volume_change / p.volume), largest_part) : largest_part);
  };
  for (int pass = 0; pass < cell.count; ++pass) {
    double volume = 0, work = 0, slack = 0, compliance = 0;
    for (int k = 0; k < cell.count; ++k) {
      MixedCell::Part& p = cell.part[k];
      const double most = p.is_void ? 0.0 : may_change(p);
      if (!p.is_void && !capped[k] && std::abs(p.volume_change) > most * (1 + 1e-12)) {
        const double change = std::copysign(most, p.volume_change);
        const double own = -(p.pressure - 0.5 * p.modulus * change / p.volume) * change;
        volume += p.volume_change - change;
        work += p.work - own;
        slack += p.slack;
        p.volume_change = change;
        p.work = own;
        p.slack = 0;
        capped[k] = true;
      }
    }
    for (int k = 0; k < cell.count; ++k) {
      compliance += cell.part[k].is_void || capped[k] ? 0 : cell.part[k].volume / cell.part[k].modulus;
    }
    if (volume == 0) {
      return;
    }
    if (compliance == 0) { // the whole cell at once: by volume after all, the step's own limits apply
      double whole = 0;
      for (int k = 0; k < cell.count; ++k) {
        whole += cell.part[k].is_void ? 0 : cell.part[k].volume;
      }
      for (int k = 0; k < cell.count; ++k) {
        MixedCell::Part& p = cell.part[k];
        const double share = p.is_void ? 0 : p.volume / whole;
        p.volume_change += volume * share;
        p.work += work * share;
        p.slack += slack * share;
      }
      return;
    }
    for (int k = 0; k < cell.count; ++k) {
      MixedCell::Part& p = cell.part[k];
      if (!p.is_void && !capped[k]) {
        const double share = (p.volume / p.modulus) / compliance;
        p.volume_change += volume * share;
        p.work += work * share;
        p.slack += slack * share;
      }
    }
  }
}

/// Materials beside void: void first, then by compliance; each relaxes towards the void's pressure.
void share_with_void(const CellMotion& m, MixedCell& cell, MixedCell::Part& hole) {
  const int solids = cell.count - 1;
  const double taken = std::max(m.volume_change, -hole.volume);
  const double rest = m.volume_change - taken;
  double hole_volume = hole.volume + taken;
  double compliance = 0;
  for (int k = 0; k < solids; ++k) {
    compliance += cell.part[k].volume / cell.part[k].modulus;
  }
  for (int k = 0; k < solids; ++k) {
    MixedCell::Part& p = cell.part[k];
    p.volume_change = compliance > 0 ? rest * (p.volume / p.modulus) / compliance : 0;
    p.work = -hole.pressure * p.volume_change; // the forces of the step were the void's
  }
  cap_changes(cell);
  // Materials in tension close up first and leave room, those under pressure then expand into it.
  for (const bool expanding : {false, true}) {
    double wanted = 0;
    for (int k = 0; k < solids; ++k) {
      const MixedCell::Part& p = cell.part[k];
      const double d = p.volume / p.modulus * (p.pressure - hole.pressure);
      wanted += (d > 0) == expanding ? d : 0;
    }
    const double share = expanding && wanted > hole_volume ? hole_volume / wanted : 1.0;
    for (int k = 0; k < solids; ++k) {
      MixedCell::Part& p = cell.part[k];
      double d = p.volume / p.modulus * (p.pressure - hole.pressure);
      if ((d > 0) != expanding || d == 0) {
        continue;
      }
      d = expanding ? d * share : std::max(d, -largest_part * p.volume);
      p.volume_change += d;
      hole_volume -= d;
      p.work -= hole.pressure * d; // the void's pressure is what it pushes against
    }
  }
  hole.volume_change = hole_volume - hole.volume;
  hole.work = 0;
}

double limited(const MixedCell& cell, const double* exchange) {
  double a = 1;
  for (int k = 0; k < cell.count; ++k) {
    if (exchange[k] < 0) {
      a = std::min(a, largest_part * cell.part[k].volume / -exchange[k]);
    }
  }
  return a;
}

void relax(const CellMotion& m, MixedCell& cell) {
  double r[max_materials_in_cell], sum = 0, weighted = 0;
  for (int k = 0; k < cell.count; ++k) {
    r[k] = cell.part[k].volume / cell.part[k].modulus;
    sum += r[k];
    weighted += r[k] * cell.part[k].pressure;
  }
  const double mean = weighted / sum;
  double exchange[max_materials_in_cell];
  for (int k = 0; k < cell.count; ++k) {
    exchange[k] = r[k] * (cell.part[k].pressure - mean);
  }
  const double a = limited(cell, exchange);
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    const double beta = r[k] / sum;
    p.volume_change = beta * m.volume_change + a * exchange[k];
    p.slack = beta * (m.swept_volume - m.volume_change);
    p.work = -(beta * (p.pressure - m.modulus * m.compression) * m.swept_volume + a * mean * exchange[k]);
  }
  cap_changes(cell);
}

/// Tipton 1989: stiffness raised by V/(c dt), one common half-step pressure.
void tipton(const CellMotion& m, MixedCell& cell) {
  const double length = std::cbrt(m.volume);
  double stiff[max_materials_in_cell], sum = 0, weighted = 0;
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    stiff[k] = p.modulus + std::sqrt(p.modulus * p.mass / p.volume) * length / m.dt; // K (1 + L / (c dt))
    sum += p.volume / stiff[k];
    weighted += p.volume / stiff[k] * p.pressure;
  }
  const double mean = weighted / sum, bulk = m.volume / sum;
  double exchange[max_materials_in_cell];
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    exchange[k] = p.volume / stiff[k] * (p.pressure - mean) +
                  p.volume / m.volume * (bulk / stiff[k] - 1) * m.volume_change;
  }
  const double a = limited(cell, exchange);
  const double p_half = m.pressure - m.modulus * m.compression;
  double rest = -p_half * m.swept_volume, mass = 0;
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    const double strain = p.volume / m.volume, worked = strain * m.swept_volume + a * exchange[k];
    p.volume_change = strain * m.volume_change + a * exchange[k];
    p.slack = strain * (m.swept_volume - m.volume_change);
    p.work = -(p.pressure - 0.5 * p.modulus * p.volume_change / p.volume) * worked; // its own: a gas cannot pull as metal does
    rest -= p.work;
    mass += p.mass;
  }
  for (int k = 0; k < cell.count; ++k) {
    cell.part[k].work += rest * (cell.part[k].mass / mass);
  }
  cap_changes(cell);
}

void equal_strain(const CellMotion& m, MixedCell& cell) {
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    const double share = p.volume / m.volume;
    p.volume_change = share * m.volume_change;
    p.slack = share * (m.swept_volume - m.volume_change);
    p.work = -share * (p.pressure - p.modulus * m.compression) * m.swept_volume;
  }
}

} // namespace

void share_volume_change(Closure closure, const CellMotion& motion, MixedCell& cell) {
  if (MixedCell::Part* hole = void_part(cell)) {
    share_with_void(motion, cell, *hole);
    return;
  }
  switch (closure) {
  case Closure::pressure_relaxation: return relax(motion, cell);
  case Closure::tipton: return tipton(motion, cell);
  case Closure::equal_strain: return equal_strain(motion, cell);
  }
}

void stiffen_cold(MixedCell& cell, double reference) {
  constexpr double trace = 1e-12, least = 1e-200; // of the stiffest; Pa, if all are cold
  double most = 0;
  for (int k = 0; k < cell.count; ++k) {
    most = std::max(most, cell.part[k].modulus);
  }
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    if (!p.is_void) {
      p.modulus = std::max({p.modulus, std::abs(p.pressure + reference), p.modulus > 0 ? 0.0 : trace * most, least});
    }
  }
}

CellPressure mixed_pressure(Closure closure, const MixedCell& cell, double void_pressure) {
  double compliance = 0, weighted = 0, volume = 0, strained = 0, stiffness = 0;
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    if (p.is_void) {
      return {void_pressure, 0};
    }
    compliance += p.volume / p.modulus;
    weighted += p.volume / p.modulus * p.pressure;
    volume += p.volume;
    strained += p.volume * p.pressure;
    stiffness += p.volume * p.modulus;
  }
  if (closure == Closure::equal_strain) {
    return {strained / volume, stiffness / volume};
  }
  return {weighted / compliance, volume / compliance};
}

} // namespace ballast
