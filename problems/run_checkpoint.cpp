#include "ale/traction.hpp"
#include "problems/run_checkpoint.hpp"

#include "core/error.hpp"
#include "core/io/checkpoint.hpp"
#include "ale/embedding.hpp"
#include "problems/layers_checkpoint.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {

namespace {

/// Calls visit(key, values) for every double array of a block that a step reads and no phase recomputes.
template <int Dim, class BlockType, class Visit> void visit_fields(BlockType& b, Visit&& visit) {
  for (std::size_t d = 0; d < Dim; ++d) {
    visit(fmt::format("position_{}", d), b.position[d].data());
    visit(fmt::format("velocity_{}", d), b.velocity[d].data());
  }
  visit("node_mass", b.node_mass.data());
  if (b.any_sliding()) {
    visit("sliding_node_mass", b.sliding.node_mass.data());
    for (std::size_t d = 0; d < Dim; ++d) {
      visit(fmt::format("sliding_jump_{}", d), b.sliding.jump[d].data());
    }
  }
  visit("volume", b.volume.data());
  for (std::size_t d = 0; d < Dim && b.motion.moves_target(); ++d) {
    visit(fmt::format("target_{}", d), b.target[d].data());
  }
}

std::vector<double> pack(const Ledger& l) {
  std::vector<double> v = {l.boundary_work, l.ambient_work, l.void_work, l.remap_kinetic_loss, l.remap_kinetic_return,
                           l.energy_out, l.momentum_out[0], l.momentum_out[1], l.momentum_out[2], l.sliver_energy,
                           l.sliver_mass, static_cast<double>(l.slivers), static_cast<double>(l.spalled_cells),
                           static_cast<double>(l.energy_floors), static_cast<double>(l.retries), static_cast<double>(l.closed_voids),
                           l.sliding_impact, l.embedded_given};
  v.insert(v.end(), l.mass_out.begin(), l.mass_out.end());
  return v;
}

void unpack(const std::vector<double>& v, Ledger& l) {
  l.boundary_work = v.at(0);
  l.ambient_work = v.at(1);
  l.void_work = v.at(2);
  l.remap_kinetic_loss = v.at(3);
  l.remap_kinetic_return = v.at(4);
  l.energy_out = v.at(5);
  l.momentum_out = {v.at(6), v.at(7), v.at(8)};
  l.sliver_energy = v.at(9);
  l.sliver_mass = v.at(10);
  l.slivers = static_cast<long>(v.at(11));
  l.spalled_cells = static_cast<long>(v.at(12));
  l.energy_floors = static_cast<long>(v.at(13));
  l.retries = static_cast<long>(v.at(14));
  l.closed_voids = static_cast<long>(v.at(15));
  l.sliding_impact = v.at(16);
  l.embedded_given = v.at(17);
  l.mass_out.assign(v.begin() + 18, v.end());
}

template <int Dim> bool any_tissue(const Scene<Dim>& scene) {
  return std::any_of(scene.blocks.begin(), scene.blocks.end(), [](const Block<Dim>& b) {
    return std::any_of(b.materials.begin(), b.materials.end(), [](const MaterialSlot& s) { return s.memories > 0; });
  });
}

constexpr const char* tissue_key = "tissue_account"; // once "tissue": without what was floored

/// Counts, then energies by material; seconds and the worst estimate are of no use to a restart but to its summary.
std::vector<double> pack_tissue(const Ledger& l) {
  const TissueCounts& c = l.tissue_counts;
  const auto number = [](long n) { return static_cast<double>(n); };
  std::vector<double> v = {number(l.tissue_repairs), number(c.fast[0]), number(c.fast[1]), number(c.fast[2]), number(c.fast[3]), number(c.over),
                           number(c.no_number), number(c.stiff), c.worst_estimate, number(c.cvode.batches), number(c.cvode.cells),
                           number(c.cvode.steps), number(c.cvode.rates), number(c.cvode.solves), number(c.cvode.failures), c.cvode.seconds, c.seconds};
  for (const TissueEnergy& e : l.tissue) {
    v.insert(v.end(), {e.work, e.dissipated, e.lost, e.floored});
  }
  return v;
}

void unpack_tissue(const std::vector<double>& v, Ledger& l) {
  std::size_t at = 0;
  const auto number = [&] { return v.at(at++); };
  const auto count = [&] { return static_cast<long>(number()); };
  TissueCounts& c = l.tissue_counts;
  for (long* n : {&l.tissue_repairs, &c.fast[0], &c.fast[1], &c.fast[2], &c.fast[3], &c.over, &c.no_number, &c.stiff}) {
    *n = count();
  }
  c.worst_estimate = number();
  for (long* n : {&c.cvode.batches, &c.cvode.cells, &c.cvode.steps, &c.cvode.rates, &c.cvode.solves, &c.cvode.failures}) {
    *n = count();
  }
  c.cvode.seconds = number();
  c.seconds = number();
  l.tissue.clear();
  while (at < v.size()) {
    const double work = number(), dissipated = number(), lost = number(), floored = number();
    l.tissue.push_back({work, dissipated, lost, floored});
  }
}

} // namespace

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Scene<Dim>& scene, const Clock& clock, const RunMemory& memory) {
  io::CheckpointWriter out(path);
  out.put("deck_hash", memory.deck_hash);
  out.put("clock/state", std::vector<double>{clock.time, clock.end_time, clock.dt});
  std::vector<std::int64_t> counts = {clock.step};
  counts.insert(counts.end(), clock.census.begin(), clock.census.end());
  out.put("clock/counts", counts);
  out.put("ledger", pack(scene.ledger));
  if (any_tissue(scene)) {
    out.put(tissue_key, pack_tissue(scene.ledger));
  }
  out.put("memory/start", std::vector<double>{memory.energy_start, memory.momentum_start[0], memory.momentum_start[1],
                                              memory.momentum_start[2], memory.next_fields, memory.next_history, memory.wall_before});
  out.put("memory/mass_start", memory.mass_start);
  out.put("memory/gauges", memory.gauges);
  out.put("memory/results", memory.results);
  out.put("memory/observed", memory.observed);
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    const Block<Dim>& b = scene.blocks[ib];
    const std::string base = fmt::format("block_{}/", ib);
    const auto put = [&](const std::string& name, const std::vector<double>& v) { out.put(base + name, v); };
    visit_fields<Dim>(b, put);
    put("reference_pressure", {b.reference_pressure});
    for (std::size_t m = 0; m < b.materials.size(); ++m) {
      const TileStore& store = b.materials[m].store;
      const std::string mat = base + fmt::format("material_{}/", m);
      std::vector<std::int64_t> tiles = {store.current()};
      for (int t = 0; t < store.tile_count(); ++t) {
        if (store.allocated(t)) {
          tiles.push_back(t);
          out.put(mat + fmt::format("tile_{}", t), std::span<const double>(store.tile_data(t), store.tile_doubles()));
        }
      }
      out.put(mat + "tiles", tiles);
    }
  }
  put_layers(out, scene.layers);
  put_embedded(out, scene);
  out.commit();
}

template <int Dim>
void read_checkpoint(const std::filesystem::path& path, Scene<Dim>& scene, Clock& clock, RunMemory& memory) {
  const io::CheckpointReader in(path);
  if (in.get_string("deck_hash") != memory.deck_hash) {
    throw Error(fmt::format("{}: the checkpoint belongs to another deck (or other --set values); restart with the deck that wrote it",
                            path.string()));
  }
  const auto state = in.get_doubles("clock/state");
  clock.time = state.at(0);
  clock.dt = state.at(2);
  const auto counts = in.get_ints("clock/counts");
  clock.step = static_cast<long>(counts.at(0));
  for (std::size_t q = 0; q < clock.census.size(); ++q) {
    clock.census[q] = static_cast<long>(counts.at(q + 1));
  }
  const auto ledger = in.get_doubles("ledger");
  if (ledger.size() != pack(scene.ledger).size()) {
    throw Error(fmt::format("{}: written by a version of the program that kept another ledger; start the deck anew", path.string()));
  }
  unpack(ledger, scene.ledger);
  if (any_tissue(scene)) {
    unpack_tissue(in.get_doubles(tissue_key), scene.ledger);
  }
  const auto start = in.get_doubles("memory/start");
  memory.energy_start = start.at(0);
  memory.momentum_start = {start.at(1), start.at(2), start.at(3)};
  memory.next_fields = start.at(4);
  memory.next_history = start.at(5);
  memory.wall_before = start.at(6);
  memory.mass_start = in.get_doubles("memory/mass_start");
  memory.gauges = in.get_doubles("memory/gauges");
  memory.results = in.get_doubles("memory/results");
  memory.observed = in.get_doubles("memory/observed");
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    Block<Dim>& b = scene.blocks[ib];
    const std::string base = fmt::format("block_{}/", ib);
    const auto fit = [&](const std::string& key, std::vector<double> v, std::size_t want) {
      if (v.size() != want) {
        throw Error(fmt::format("{}: {} holds {} values, the scene needs {}", path.string(), key, v.size(), want));
      }
      return v;
    };
    if (fit(base + "reference_pressure", in.get_doubles(base + "reference_pressure"), 1)[0] != b.reference_pressure) {
      throw Error(fmt::format("{}: written by a version of the program that took forces against another pressure; start the deck anew", path.string()));
    }
    visit_fields<Dim>(b, [&](const std::string& name, std::vector<double>& v) {
      v = fit(base + name, in.get_doubles(base + name), v.size());
    });
    for (std::size_t m = 0; m < b.materials.size(); ++m) {
      TileStore& store = b.materials[m].store;
      const std::string mat = base + fmt::format("material_{}/", m);
      const auto tiles = in.get_ints(mat + "tiles");
      store.set_current(static_cast<int>(tiles.at(0)));
      for (int t = 0; t < store.tile_count(); ++t) {
        store.release(t);
      }
      for (std::size_t q = 1; q < tiles.size(); ++q) {
        const int t = static_cast<int>(tiles[q]);
        const std::string key = mat + fmt::format("tile_{}", t);
        store.allocate(t);
        const auto data = fit(key, in.get_doubles(key), store.tile_doubles());
        std::copy(data.begin(), data.end(), store.tile_data(t));
      }
    }
    update_state(b, *scene.pool);
    update_traction(b, *scene.pool, false);
  }
  get_layers(in, scene.layers);
  get_embedded(in, scene);
}

template void write_checkpoint<2>(const std::filesystem::path&, const Scene<2>&, const Clock&, const RunMemory&);
template void write_checkpoint<3>(const std::filesystem::path&, const Scene<3>&, const Clock&, const RunMemory&);
template void read_checkpoint<2>(const std::filesystem::path&, Scene<2>&, Clock&, RunMemory&);
template void read_checkpoint<3>(const std::filesystem::path&, Scene<3>&, Clock&, RunMemory&);

} // namespace ballast
