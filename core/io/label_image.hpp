// Label images: a whole number for every voxel of a block, as segmentation tools write them.
//
// MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr) and NIfTI (.nii, .nii.gz). A voxel is a box around the place that the file
// gives for it: the file's origin is the centre of the first voxel, in all three formats.
//
// Axes: a step along each axis of the image must go along x, y or z of the file's space. Which one, and whether up or
// down, is free: the voxels are put in the order of x, y, z (a file in "left, posterior, superior" and the same in "right,
// anterior, superior" then differ in the sign of x and y, as they say). Anything between the axes is refused.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ballast::io {

struct LabelImage {
  std::array<std::size_t, 3> size{};  ///< voxels along x, y, z
  std::array<double, 3> corner{};     ///< low corner of the first voxel, in the file's unit of length
  std::array<double, 3> spacing{};    ///< sides of a voxel, above 0
  std::vector<std::uint16_t> labels;  ///< x runs fastest
  std::string checksum;               ///< of all the above: FNV-1a 64 bit, 16 hexadecimal digits
  std::string problem;                ///< empty: read well
  std::string cure;                   ///< what would be right, with `problem`
};

/// Never throws for what is wrong with the file: see `problem`.
LabelImage read_label_image(const std::string& path);

} // namespace ballast::io
