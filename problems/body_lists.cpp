// Bodies that other sections name.
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

int body_called(const SceneSpec& scene, const std::string& name) {
  const auto at = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == name; });
  return at == scene.bodies.end() ? -1 : static_cast<int>(at - scene.bodies.begin());
}

std::string text_of(const DeckNode& table, const char* key) {
  const DeckNode* node = table.find(key);
  return node != nullptr ? node->text : "";
}

/// Names of the bodies that the [[body]] entries are to make, whether they could be read or not.
std::vector<std::string> declared_bodies(const Deck& deck) {
  std::vector<std::string> names;
  const DeckNode* list = deck.root().find("body");
  for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
    const DeckNode& item = list->items[i];
    const std::string name = text_of(item, "name");
    const Part* part = find_part(text_of(item, "use"));
    for (std::size_t q = 0; part != nullptr && q < part->bodies.size(); ++q) {
      names.push_back(name.empty() ? part->bodies[q].name : fmt::format("{}.{}", name, part->bodies[q].name));
    }
    if (part == nullptr) {
      names.push_back(name);
    }
  }
  return names;
}

} // namespace

bool bodies_missing(const Deck& deck, const SceneSpec& scene) {
  const std::vector<std::string> names = declared_bodies(deck);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return body_called(scene, name) < 0; });
}

std::vector<int> listed_bodies(Deck& deck, DeckNode& list, const SceneSpec& scene) {
  std::vector<int> bodies;
  std::vector<std::string> names;
  for (const Body& b : scene.bodies) {
    names.push_back(b.name);
  }
  const std::vector<std::string> declared = declared_bodies(deck);
  for (DeckNode& item : list.items) {
    const int body = body_called(scene, item.text);
    if (body >= 0) {
      bodies.push_back(body);
    } else if (std::find(declared.begin(), declared.end(), item.text) == declared.end()) { // else it has had its error
      const std::string meant = nearest(item.text, names);
      deck.fail(item,
                fmt::format("no body is called \"{}\"{}", item.text, meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
                one_of(names));
    }
  }
  return bodies;
}

std::vector<int> listed_materials(Deck& deck, DeckNode* list, const SceneSpec& scene) {
  std::vector<int> order;
  std::vector<std::string> names;
  for (const Material& m : scene.materials) {
    names.push_back(m.name);
  }
  for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
    DeckNode& item = list->items[i];
    const auto at = std::find(names.begin(), names.end(), item.text);
    const int index = static_cast<int>(at - names.begin());
    if (at == names.end() && bodies_missing(deck, scene)) {
      continue; // it may be of one of those
    }
    if (at == names.end() || std::find(order.begin(), order.end(), index) != order.end()) {
      deck.fail(item,
                at == names.end() ? fmt::format("\"{}\" is in no body", item.text)
                                  : fmt::format("\"{}\" is listed twice", item.text),
                one_of(names) + ", each once");
      continue;
    }
    order.push_back(index);
  }
  return order;
}

} // namespace ballast
