// `voxels` of shapes: labels of an image.
#include "core/io/label_image.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"
#include "problems/voxel_solid.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ballast {
namespace {

/// How often each label is in the image.
std::vector<std::size_t> counts_of(const io::LabelImage& image) {
  std::vector<std::size_t> counts(65536);
  for (const std::uint16_t label : image.labels) {
    ++counts[label];
  }
  return counts;
}

/// "0 (12 voxels), 3 (1 voxel) ..."
std::string list_of(const std::vector<std::size_t>& counts) {
  constexpr std::size_t most = 20; // to name
  std::vector<std::string> names;
  std::size_t more = 0;
  for (std::size_t label = 0; label < counts.size(); ++label) {
    if (counts[label] > 0 && names.size() < most) {
      names.push_back(fmt::format("{} ({} voxel{})", label, counts[label], counts[label] == 1 ? "" : "s"));
    } else {
      more += counts[label] > 0;
    }
  }
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

/// Marks the labels of one number or a list of them; false (and an error) for what is not in the image.
bool read_labels(Deck& deck, DeckNode& node, const std::vector<std::size_t>& counts, std::vector<bool>& wanted) {
  std::vector<DeckNode*> given;
  for (DeckNode& item : node.items) {
    given.push_back(&item);
  }
  if (!node.is_array()) {
    given.push_back(&node);
  }
  if (given.empty()) {
    deck.fail(node, "no label is given", "a whole number, or a list of them");
    return false;
  }
  for (DeckNode* label : given) {
    const double value = label->kind == DeckNode::Kind::integer ? label->number : -1;
    if (value < 0 || value > 65535) {
      deck.fail(*label, fmt::format("{} is no label", label->is_number() ? fmt::format("{:g}", label->number) : describe(*label)), "a whole number from 0 to 65535, or a list of them");
      return false;
    }
    const auto at = static_cast<std::size_t>(value);
    if (counts[at] == 0) {
      deck.fail(*label, fmt::format("no voxel of the image has the label {}", at), fmt::format("a label that is there: {}", list_of(counts)));
      return false;
    }
    wanted[at] = true;
  }
  return true;
}

std::shared_ptr<const VoxelSolid> solid_of(const io::LabelImage& image, const std::vector<bool>& wanted, double scale) {
  std::vector<bool> filled(image.labels.size());
  std::transform(image.labels.begin(), image.labels.end(), filled.begin(), [&](std::uint16_t label) { return wanted[label]; });
  VoxelIndex size{};
  Point corner{}, spacing{};
  for (std::size_t k = 0; k < 3; ++k) {
    size[k] = static_cast<std::ptrdiff_t>(image.size[k]);
    corner[k] = image.corner[k] * scale;
    spacing[k] = image.spacing[k] * scale;
  }
  return std::make_shared<const VoxelSolid>(size, corner, spacing, filled);
}

} // namespace

std::optional<Shape> read_voxels(Deck& deck, DeckNode& node, Geometry geometry) {
  if (geometry != Geometry::three_d) {
    deck.fail_key(node, fmt::format("a block of voxels in a scene that is {}", name_of(geometry)), "geometry = \"3d\", or another shape");
    return std::nullopt;
  }
  const Section in = read_section(deck, node, scene_keys::voxels());
  if (!in.has("file") || !in.has("label") || !in.has("units")) {
    return std::nullopt;
  }
  const std::optional<double> scale = read_units(deck, in);
  if (!scale) {
    return std::nullopt;
  }
  const std::string path = deck.resolve_path(in.text("file"));
  const io::LabelImage image = io::read_label_image(path);
  if (!image.problem.empty()) {
    deck.fail(*in.node("file"), image.problem, image.cure);
    return std::nullopt;
  }
  std::vector<bool> wanted(65536);
  if (!read_labels(deck, *in.node("label"), counts_of(image), wanted)) {
    return std::nullopt;
  }
  pin_file(deck, in, path, image.checksum);
  return Shape{Voxels{solid_of(image, wanted, *scale)}};
}

} // namespace ballast
