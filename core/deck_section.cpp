// A section that has been read, and its key table: look-up by name.
#include "core/deck_keys.hpp"

#include <algorithm>

namespace ballast {

const KeySpec* SectionSpec::find(std::string_view name) const {
  const auto at =
      std::find_if(keys.begin(), keys.end(), [&](const KeySpec& k) { return k.name == name; });
  return at == keys.end() ? nullptr : &*at;
}

DeckNode* Section::good(std::string_view key) const {
  DeckNode* found = node_->find(key);
  return found != nullptr && !found->bad ? found : nullptr;
}

bool Section::has(std::string_view key) const {
  return good(key) != nullptr;
}
DeckNode* Section::node(std::string_view key) const {
  return good(key);
}

double Section::number(std::string_view key, double absent) const {
  const DeckNode* n = good(key);
  return n != nullptr ? n->number : absent;
}

int Section::integer(std::string_view key) const {
  const DeckNode* n = good(key);
  return n != nullptr ? static_cast<int>(n->number) : 0;
}

bool Section::flag(std::string_view key) const {
  const DeckNode* n = good(key);
  return n != nullptr && n->flag;
}

std::string Section::text(std::string_view key, std::string absent) const {
  const DeckNode* n = good(key);
  return n != nullptr ? n->text : absent;
}

std::vector<double> Section::numbers(std::string_view key) const {
  const DeckNode* n = good(key);
  return n != nullptr ? numbers_of(*n) : std::vector<double>{};
}

std::vector<std::string> Section::texts(std::string_view key) const {
  std::vector<std::string> out;
  if (const DeckNode* n = good(key)) {
    for (const DeckNode& item : n->items) {
      out.push_back(item.text);
    }
  }
  return out;
}

int Section::choice(std::string_view key) const {
  const KeySpec* spec = spec_->find(key);
  const DeckNode* n = good(key);
  if (spec == nullptr || n == nullptr) {
    return 0;
  }
  const auto at = std::find(spec->choices.begin(), spec->choices.end(), n->text);
  return at == spec->choices.end() ? 0 : static_cast<int>(at - spec->choices.begin());
}

} // namespace ballast
