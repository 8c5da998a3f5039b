#include "problems/layers_checkpoint.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <type_traits>

namespace ballast {

namespace {

/// Calls visit(key, values) for every array of a stack that the next step reads and nothing recomputes.
template <int Dim, class Stack, class Visit> void visit_stack(Stack& s, const std::string& base, Visit&& visit) {
  for (std::size_t d = 0; d < Dim; ++d) {
    visit(base + fmt::format("position_{}", d), s.position[d]);
    visit(base + fmt::format("velocity_{}", d), s.velocity[d]);
    visit(base + fmt::format("force_{}", d), s.force[d]);
  }
  for (std::size_t point = 0; point < 2; ++point) {
    for (std::size_t yarn = 0; yarn < 2; ++yarn) {
      visit(base + fmt::format("largest_{}_{}", point, yarn), s.largest[point][yarn]);
      visit(base + fmt::format("rate_{}_{}", point, yarn), s.rate[point][yarn]);
    }
  }
  visit(base + "mass", s.mass);
  visit(base + "energy", s.energy);
  visit(base + "hourglass_energy", s.hourglass_energy);
  visit(base + "shock_heat", s.shock_heat);
  visit(base + "wave_step", s.wave_step);
  visit(base + "alive", s.alive);
  visit(base + "stress_volume", s.stress_volume);
  visit(base + "hourglass_volume", s.hourglass_volume);
  visit(base + "shock_volume", s.shock_volume);
}

/// Likewise of the nodes' feet; arrays as long as what was seen.
template <int Dim, class Track, class Visit> void visit_track(Track& t, const std::string& base, Visit&& visit) {
  visit(base + "status", t.status);
  visit(base + "segment", t.segment);
  visit(base + "local", t.local);
  visit(base + "gap", t.gap);
  visit(base + "opening", t.opening);
  visit(base + "leaves", t.leaves);
  for (std::size_t d = 0; d < Dim; ++d) {
    visit(base + fmt::format("normal_{}", d), t.normal[d]);
  }
  visit(base + "current", t.current);
  visit(base + "moved", t.moved);
}

template <class T> std::vector<double> as_numbers(const std::vector<T>& values) {
  std::vector<double> out;
  for (const T& v : values) {
    if constexpr (std::is_same_v<T, std::array<double, 2>>) {
      out.insert(out.end(), v.begin(), v.end());
    } else {
      out.push_back(static_cast<double>(v));
    }
  }
  return out;
}

template <class T> std::vector<T> from_numbers(const std::vector<double>& numbers) {
  std::vector<T> out;
  if constexpr (std::is_same_v<T, std::array<double, 2>>) {
    for (std::size_t q = 0; q + 1 < numbers.size(); q += 2) {
      out.push_back({numbers[q], numbers[q + 1]});
    }
  } else {
    for (const double v : numbers) {
      out.push_back(static_cast<T>(v));
    }
  }
  return out;
}

template <int Dim> std::vector<double> pack(const Layers<Dim>& l) {
  const LayerLedger& g = l.ledger;
  return {g.edge_work, g.contact_loss, g.friction_loss, g.eroded_energy, g.edge_impulse[0], g.edge_impulse[1], g.edge_impulse[2],
          static_cast<double>(g.eroded_elements), static_cast<double>(g.crushed), g.deepest, g.edge_loss, g.step_change, l.stack.step, l.closing,
          static_cast<double>(l.steps), static_cast<double>(l.slidelines.steps), static_cast<double>(l.slidelines.pairs.size()), static_cast<double>(l.with_blocks.size()),
          static_cast<double>(g.turned_over), static_cast<double>(g.behind), g.load_work, static_cast<double>(l.with_stacks.size()),
          static_cast<double>(l.slidelines.holes.size())};
}

template <int Dim> void unpack(const std::vector<double>& v, Layers<Dim>& l) {
  if (v.size() != pack(l).size()) {
    throw Error(fmt::format("the checkpoint's state of {} holds {} numbers, not {}: it is of another version; start the deck anew", l.stack.name, v.size(), pack(l).size()));
  }
  LayerLedger& g = l.ledger;
  g.edge_work = v.at(0);
  g.contact_loss = v.at(1);
  g.friction_loss = v.at(2);
  g.eroded_energy = v.at(3);
  g.edge_impulse = {v.at(4), v.at(5), v.at(6)};
  g.eroded_elements = static_cast<long>(v.at(7));
  g.crushed = static_cast<long>(v.at(8));
  g.deepest = v.at(9);
  g.edge_loss = v.at(10);
  g.step_change = v.at(11);
  l.stack.step = v.at(12);
  l.closing = v.at(13);
  l.steps = static_cast<long>(v.at(14));
  l.slidelines.steps = static_cast<long>(v.at(15));
  l.slidelines.pairs.assign(static_cast<std::size_t>(v.at(16)), {});
  l.with_blocks.assign(static_cast<std::size_t>(v.at(17)), {});
  g.load_work = v.at(20);
  g.turned_over = static_cast<long>(v.at(18));
  g.behind = static_cast<long>(v.at(19));
  l.with_stacks.assign(static_cast<std::size_t>(v.at(21)), {});
  l.slidelines.holes.assign(static_cast<std::size_t>(v.at(22)), {});
}

template <int Dim> void put_contact(io::CheckpointWriter& out, const std::string& at, const ContactState<Dim>& c) {
  out.put(at + "state", std::vector<double>{c.travel, static_cast<double>(c.steps), c.taken});
  for (std::size_t s = 0; s < 2; ++s) {
    visit_track<Dim>(c.tracks[s], at + fmt::format("nodes_{}/", s), [&](const std::string& key, const auto& values) {
      if (!values.empty()) {
        out.put(key, as_numbers(values));
      }
    });
  }
}

template <int Dim> void get_contact(const io::CheckpointReader& in, const std::string& at, ContactState<Dim>& c) {
  const std::vector<double> state = in.get_doubles(at + "state");
  c.travel = state.at(0);
  c.steps = static_cast<long>(state.at(1));
  c.taken = state.at(2);
  for (std::size_t s = 0; s < 2; ++s) {
    visit_track<Dim>(c.tracks[s], at + fmt::format("nodes_{}/", s), [&]<class T>(const std::string& key, std::vector<T>& values) {
      if (in.has(key)) {
        values = from_numbers<T>(in.get_doubles(key));
      }
    });
  }
}

/// Calls visit(key, state) for every contact of a stack; there are as many as unpack has made room for.
template <int Dim, class L, class Visit> void visit_contacts(L& l, const std::string& base, Visit&& visit) {
  for (std::size_t q = 0; q < l.slidelines.pairs.size(); ++q) {
    visit(base + fmt::format("slideline_{}/", q), l.slidelines.pairs[q]);
  }
  for (std::size_t q = 0; q < l.slidelines.holes.size(); ++q) {
    visit(base + fmt::format("hole_{}/", q), l.slidelines.holes[q].state);
  }
  for (std::size_t q = 0; q < l.with_blocks.size(); ++q) {
    visit(base + fmt::format("with_block_{}/", q), l.with_blocks[q]);
  }
  for (std::size_t q = 0; q < l.with_stacks.size(); ++q) {
    visit(base + fmt::format("with_stack_{}/", q), l.with_stacks[q].state);
  }
}

} // namespace

template <int Dim> void put_layers(io::CheckpointWriter& out, const std::vector<Layers<Dim>>& layers) {
  for (std::size_t q = 0; q < layers.size(); ++q) {
    const Layers<Dim>& l = layers[q];
    const std::string base = fmt::format("layers_{}/", q);
    out.put(base + "state", pack(l));
    visit_stack<Dim>(l.stack, base, [&](const std::string& key, const auto& values) {
      if (!values.empty()) {
        out.put(key, as_numbers(values));
      }
    });
    visit_contacts<Dim>(l, base, [&](const std::string& key, const ContactState<Dim>& state) { put_contact(out, key, state); });
    for (std::size_t c = 0; c < l.with_stacks.size(); ++c) {
      const StackContact<Dim>& with = l.with_stacks[c];
      out.put(base + fmt::format("with_stack_{}/layers", c), std::vector<std::int64_t>{with.other, with.layer, with.other_layer});
    }
    for (std::size_t c = 0; c < l.slidelines.holes.size(); ++c) {
      const HoleContact<Dim>& hole = l.slidelines.holes[c];
      out.put(base + fmt::format("hole_{}/layers", c), std::vector<std::int64_t>{hole.lower, hole.upper});
    }
  }
}

template <int Dim> void get_layers(const io::CheckpointReader& in, std::vector<Layers<Dim>>& layers) {
  for (std::size_t q = 0; q < layers.size(); ++q) {
    Layers<Dim>& l = layers[q];
    const std::string base = fmt::format("layers_{}/", q);
    unpack(in.get_doubles(base + "state"), l);
    visit_stack<Dim>(l.stack, base, [&]<class T>(const std::string& key, std::vector<T>& values) {
      if (values.empty()) {
        return;
      }
      const std::vector<double> numbers = in.get_doubles(key);
      if (numbers.size() != values.size()) {
        throw Error(fmt::format("{} of the checkpoint holds {} values, {} needs {}; restart with the deck that wrote it", key, numbers.size(), l.stack.name, values.size()));
      }
      values = from_numbers<T>(numbers);
    });
    visit_contacts<Dim>(l, base, [&](const std::string& key, ContactState<Dim>& state) { get_contact(in, key, state); });
    for (std::size_t c = 0; c < l.with_stacks.size(); ++c) {
      const std::vector<std::int64_t> with = in.get_ints(base + fmt::format("with_stack_{}/layers", c));
      l.with_stacks[c].other = static_cast<int>(with.at(0));
      l.with_stacks[c].layer = static_cast<int>(with.at(1));
      l.with_stacks[c].other_layer = static_cast<int>(with.at(2));
    }
    for (std::size_t c = 0; c < l.slidelines.holes.size(); ++c) {
      const std::vector<std::int64_t> hole = in.get_ints(base + fmt::format("hole_{}/layers", c));
      l.slidelines.holes[c].lower = static_cast<int>(hole.at(0));
      l.slidelines.holes[c].upper = static_cast<int>(hole.at(1));
    }
  }
}

template <int Dim> void put_embedded(io::CheckpointWriter& out, const Scene<Dim>& scene) {
  for (std::size_t q = 0; q < scene.embedded.size(); ++q) {
    const EmbeddingMemory memory = memory_of(*scene.embedded[q]);
    const std::string base = fmt::format("embedded_{}/", q);
    for (std::size_t s = 0; s < memory.alive.size(); ++s) {
      out.put(base + fmt::format("alive_{}", s), std::vector<std::int64_t>(memory.alive[s].begin(), memory.alive[s].end()));
    }
    out.put(base + "cells", memory.cells);
    out.put(base + "rows", std::vector<std::int64_t>{memory.rows.begin, memory.rows.end});
    std::vector<double> pockets; // three indices and the volume
    for (const Pocket& p : memory.pockets) {
      pockets.insert(pockets.end(), {static_cast<double>(p.cell[0]), static_cast<double>(p.cell[1]), static_cast<double>(p.cell[2]), p.volume});
    }
    out.put(base + "pockets", pockets);
  }
}

template <int Dim> void get_embedded(const io::CheckpointReader& in, Scene<Dim>& scene) {
  for (std::size_t q = 0; q < scene.embedded.size(); ++q) {
    const std::string base = fmt::format("embedded_{}/", q);
    if (!in.has(base + "cells")) {
      throw Error(fmt::format("the checkpoint holds no {}: written by a version of the program that kept less; start the deck anew", base));
    }
    EmbeddingMemory memory;
    for (std::size_t s = 0; s < scene.layers.size(); ++s) {
      const std::vector<std::int64_t> alive = in.get_ints(base + fmt::format("alive_{}", s));
      memory.alive.emplace_back(alive.begin(), alive.end());
    }
    memory.cells = in.get_ints(base + "cells");
    const std::vector<std::int64_t> rows = in.get_ints(base + "rows");
    memory.rows = {static_cast<int>(rows.at(0)), static_cast<int>(rows.at(1))};
    const std::vector<double> pockets = in.get_doubles(base + "pockets");
    for (std::size_t n = 0; n + 3 < pockets.size(); n += 4) {
      memory.pockets.push_back({{static_cast<int>(pockets[n]), static_cast<int>(pockets[n + 1]), static_cast<int>(pockets[n + 2])}, pockets[n + 3]});
    }
    find_bodies(scene, *scene.embedded[q], memory);
  }
}

template void put_embedded<2>(io::CheckpointWriter&, const Scene<2>&);
template void put_embedded<3>(io::CheckpointWriter&, const Scene<3>&);
template void get_embedded<2>(const io::CheckpointReader&, Scene<2>&);
template void get_embedded<3>(const io::CheckpointReader&, Scene<3>&);
template void put_layers<2>(io::CheckpointWriter&, const std::vector<Layers<2>>&);
template void put_layers<3>(io::CheckpointWriter&, const std::vector<Layers<3>>&);
template void get_layers<2>(const io::CheckpointReader&, std::vector<Layers<2>>&);
template void get_layers<3>(const io::CheckpointReader&, std::vector<Layers<3>>&);

} // namespace ballast
