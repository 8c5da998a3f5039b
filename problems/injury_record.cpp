#include "problems/injury_record.hpp"

#include "problems/layers_measure.hpp"
#include "problems/run_measure.hpp"

#include <algorithm>

namespace ballast {
namespace {

constexpr std::size_t numbers_of_a_site = 6, numbers_of_an_organ = 5, numbers_of_all = 4;

void keep(Peak& largest, double value, double time, double sign) { largest = sign * value > sign * largest.value ? Peak{value, time} : largest; }

} // namespace

template <int Dim> void InjuryRecord<Dim>::follow(int gauge) {
  const bool known = std::any_of(sites_.begin(), sites_.end(), [&](const InjurySite& s) { return s.gauge == gauge; });
  if (gauge >= 0 && !known) {
    sites_.push_back({.gauge = gauge, .steps = {}});
  }
}

template <int Dim> std::size_t InjuryRecord<Dim>::site_of(int gauge) const {
  const auto at = std::find_if(sites_.begin(), sites_.end(), [&](const InjurySite& s) { return s.gauge == gauge; });
  return static_cast<std::size_t>(at - sites_.begin());
}

template <int Dim> InjuryRecord<Dim>::InjuryRecord(const SceneSpec& scene, const std::vector<int>& slots) : spec_(scene), slots_(slots) {
  if (!asked()) {
    return;
  }
  const InjurySpec& in = *spec_.injury;
  for (const int gauge : {in.sternum, in.spine, in.back_gauge}) {
    follow(gauge);
  }
  for (const int gauge : in.accelerometers) {
    follow(gauge);
  }
  for (const int material : in.organs) {
    organs_.push_back({material, {}, 0});
  }
  for (const int material : in.force_on) {
    force_slots_.push_back(slots_[static_cast<std::size_t>(material)]);
  }
  const std::size_t columns = 2 * sites_.size() + (force_slots_.empty() ? 0 : 1) + in.blast.size();
  last_.resize(columns, 0.0);
  record_ = UniformRecord(in.record_every, columns);
}

template <int Dim> void InjuryRecord<Dim>::find_peaks(const Scene<Dim>& scene, double time) {
  const InjurySpec& in = *spec_.injury;
  for (OrganPeak& organ : organs_) {
    const PressurePeak now = highest_pressure(scene.blocks[0], slots_[static_cast<std::size_t>(organ.material)], !started_, *scene.pool);
    if (now.pressure > organ.peak.pressure) {
      organ.peak = now;
      organ.time = time;
    }
  }
  if (in.back_stack >= 0) {
    const auto q = static_cast<std::size_t>(in.back_stack);
    keep(back_face_, largest_back_face(scene.layers[q].stack, spec_.layers[q].direction), time, 1);
  }
}

/// Does it still ride on what it began on?
template <int Dim>
void InjuryRecord<Dim>::watch(InjurySite& site, const Block<Dim>& b, const std::array<int, 3>& cell, const std::array<double, 3>& at, double time) {
  site.slot = started_ ? site.slot : fullest_slot(b, cell);
  if (site.lost < 0 && (!holds(b, cell, site.slot) || beyond_mesh(b, cell, at))) {
    site.lost = time;
  }
}

template <int Dim> void InjuryRecord<Dim>::step(const Scene<Dim>& scene, double time, std::span<const double> gauges) {
  if (!asked()) {
    return;
  }
  const InjurySpec& in = *spec_.injury;
  const Block<Dim>& b = scene.blocks[0];
  const auto axis = static_cast<std::size_t>(in.axis);
  std::vector<double> now;
  for (InjurySite& site : sites_) {
    const auto q = static_cast<std::size_t>(site.gauge);
    const std::array<double, 3> at = {gauges[3 * q], gauges[3 * q + 1], gauges[3 * q + 2]};
    now.push_back(in.direction * (at[axis] - spec_.gauges[q].at[axis]));
    const std::array<int, 3> cell = find_cell(b, at);
    watch(site, b, cell, at, time);
    now.push_back(in.direction * velocity_at(b, cell, at)[axis]);
    if (site.gauge == in.back_gauge) {
      keep(back_face_, now[now.size() - 2], time, 1);
    }
  }
  if (!force_slots_.empty()) {
    now.push_back(in.direction * in.copies * material_momentum(b, force_slots_, in.axis, *scene.pool));
  }
  for (const int gauge : in.blast) {
    const auto q = 3 * static_cast<std::size_t>(gauge);
    const auto cell = find_cell(b, {gauges[q], gauges[q + 1], gauges[q + 2]});
    now.push_back(b.pressure.row(b.grid.cell_row(cell[1], cell[2]))[cell[0]] + b.reference_pressure - spec_.ambient_pressure);
  }
  for (std::size_t s = 0; s < sites_.size() && time > time_; ++s) {
    const double acceleration = (now[2 * s + 1] - last_[2 * s + 1]) / (time - time_);
    keep(sites_[s].steps.along, acceleration, time, 1);
    keep(sites_[s].steps.against, acceleration, time, -1);
  }
  find_peaks(scene, time);
  record_.add(time, now);
  last_ = now;
  time_ = time;
  started_ = true;
}

template <int Dim> std::vector<double> InjuryRecord<Dim>::memory() const {
  if (!asked()) {
    return {};
  }
  std::vector<double> numbers = {time_, started_ ? 1.0 : 0.0, back_face_.value, back_face_.time};
  for (const InjurySite& s : sites_) {
    numbers.insert(numbers.end(), {s.steps.along.value, s.steps.along.time, s.steps.against.value, s.steps.against.time, static_cast<double>(s.slot), s.lost});
  }
  for (const OrganPeak& o : organs_) {
    numbers.insert(numbers.end(), {o.peak.pressure, o.peak.at[0], o.peak.at[1], o.peak.at[2], o.time});
  }
  numbers.insert(numbers.end(), last_.begin(), last_.end());
  const std::vector<double> record = record_.memory();
  numbers.insert(numbers.end(), record.begin(), record.end());
  return numbers;
}

template <int Dim> std::size_t InjuryRecord<Dim>::recall(std::span<const double> n) {
  if (!asked()) {
    return 0;
  }
  time_ = n[0];
  started_ = n[1] != 0;
  back_face_ = {n[2], n[3]};
  std::size_t at = numbers_of_all;
  for (InjurySite& s : sites_) {
    s.steps = {{n[at], n[at + 1]}, {n[at + 2], n[at + 3]}};
    s.slot = static_cast<int>(n[at + 4]);
    s.lost = n[at + 5];
    at += numbers_of_a_site;
  }
  for (OrganPeak& o : organs_) {
    o.peak = {n[at], {n[at + 1], n[at + 2], n[at + 3]}};
    o.time = n[at + 4];
    at += numbers_of_an_organ;
  }
  for (double& value : last_) {
    value = n[at++];
  }
  return at + record_.recall(n.subspan(at));
}

template class InjuryRecord<2>;
template class InjuryRecord<3>;

} // namespace ballast
