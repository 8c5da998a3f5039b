#include "problems/commands.hpp"

#include "core/deck_keys.hpp"
#include "materials/fabric_library.hpp"
#include "materials/library.hpp"
#include "problems/injury_criteria.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reader.hpp"
#include "problems/scene_report.hpp"

#include <fmt/format.h>

namespace ballast {

int check_command(const CheckOptions& options) {
  const ReadScene read = read_scene(options.deck, options.settings);
  fmt::print("{}", scene_table(read.scene));
  return static_cast<int>(ExitStatus::finished);
}

int materials_command(const std::string& name) {
  if (name.empty()) {
    for (const std::string& known : material_names()) {
      fmt::print("{}\n", describe(*find_material(known)));
    }
    for (const std::string& known : fabric_names()) {
      fmt::print("{}\n", describe(*find_fabric(known)));
    }
    return static_cast<int>(ExitStatus::finished);
  }
  const Material* material = find_material(name);
  const FabricMaterial* fabric = find_fabric(name);
  if (material == nullptr && fabric == nullptr) {
    std::vector<std::string> names = material_names();
    for (const std::string& known : fabric_names()) {
      names.push_back(known);
    }
    const std::string meant = nearest(name, names);
    throw Error(fmt::format("no material is called \"{}\"{}\n  allowed: {}\n",
                            name,
                            meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant),
                            one_of(names)));
  }
  fmt::print("{}", material != nullptr ? describe(*material) : describe(*fabric));
  return static_cast<int>(ExitStatus::finished);
}

int deck_reference_command() {
  fmt::print("{}", scene_keys::reference());
  return static_cast<int>(ExitStatus::finished);
}

int injury_reference_command() {
  fmt::print("{}", injury_reference());
  return static_cast<int>(ExitStatus::finished);
}

} // namespace ballast
