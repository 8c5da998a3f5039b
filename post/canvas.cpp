#include "post/canvas.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <numbers>
#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkTextProperty.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
#include <vtkUnicodeString.h>
#endif

#include "core/error.hpp"

namespace ballast::post {
namespace {

/// Opacity of a rendered string, top row first; its height is the font's line height.
struct Glyphs {
  int width = 0, height = 0;
  std::vector<std::uint8_t> opacity;
  std::uint8_t at(int column, int row) const {
    return opacity[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(column)];
  }
};

/// DejaVu Sans where it is installed (Debian: fonts-dejavu-core, which fontconfig brings along);
/// VTK's own font has no µ.
const std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";

void use_font(vtkTextProperty* property, bool bold) {
  const std::filesystem::path file = dejavu / (bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf");
  property->SetFontFamilyToArial();
  property->SetBold(bold);
  if (!std::filesystem::exists(file))
    return;
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile(file.c_str());
}

/// Without DejaVu, micro is written u.
std::string drawable(std::string utf8) {
  static const bool complete = std::filesystem::exists(dejavu / "DejaVuSans.ttf");
  for (std::size_t at; !complete && (at = utf8.find("µ")) != std::string::npos;) {
    utf8.erase(at, 1);
    utf8[at] = 'u';
  }
  return utf8;
}

// VTK 9.1 drops every letter beyond ASCII from std::string and draws them only from the class it
// calls deprecated; later versions have the other way only.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
vtkUnicodeString vtk_text(const std::string& utf8) {
  return vtkUnicodeString::from_utf8(utf8);
}
#else
const std::string& vtk_text(const std::string& utf8) {
  return utf8;
}
#endif

Glyphs render(const std::string& utf8, const TextStyle& style) {
  Glyphs glyphs;
  if (utf8.empty())
    return glyphs;
  vtkNew<vtkTextProperty> property;
  use_font(property, style.bold);
  property->SetFontSize(static_cast<int>(std::lround(style.size * Canvas::fine * 0.86)));
  property->SetColor(1, 1, 1);
  vtkNew<vtkImageData> image;
  int size[2] = {0, 0};
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->ScaleToPowerTwoOff();
  if (!tools->RenderString(property, vtk_text(drawable(utf8)), 72, image, size))
    return glyphs;
  int extent[6];
  image->GetExtent(extent);
  glyphs.width = std::min(size[0], extent[1] - extent[0] + 1);
  glyphs.height = std::min(size[1], extent[3] - extent[2] + 1);
  glyphs.opacity.resize(static_cast<std::size_t>(glyphs.width * glyphs.height));
  auto out = glyphs.opacity.begin();
  for (int row = glyphs.height - 1; row >= 0; --row)
    for (int column = 0; column < glyphs.width; ++column)
      *out++ = static_cast<std::uint8_t*>(
          image->GetScalarPointer(extent[0] + column, extent[2] + row, 0))[3];
  return glyphs;
}

Glyphs turned_upright(const Glyphs& flat) {
  Glyphs up{flat.height, flat.width, std::vector<std::uint8_t>(flat.opacity.size())};
  auto out = up.opacity.begin();
  for (int row = 0; row < up.height; ++row)
    for (int column = 0; column < up.width; ++column)
      *out++ = flat.at(flat.width - 1 - row, column);
  return up;
}

std::uint8_t mix(std::uint8_t below, std::uint8_t above, int opacity) {
  return static_cast<std::uint8_t>((below * (255 - opacity) + above * opacity + 127) / 255);
}

} // namespace

Canvas::Canvas(int width, int height)
    : width_(width), height_(height),
      samples_(static_cast<std::size_t>(width * fine) * static_cast<std::size_t>(height * fine),
               white) {
  unclip();
}

void Canvas::unclip() {
  clip_left_ = clip_top_ = 0;
  clip_right_ = width_ * fine;
  clip_bottom_ = height_ * fine;
}

void Canvas::clip(const Box& box) {
  const auto sample = [](double pixel) { return static_cast<int>(std::lround(pixel * fine)); };
  clip_left_ = std::max(0, sample(box.x));
  clip_top_ = std::max(0, sample(box.y));
  clip_right_ = std::min(width_ * fine, sample(box.right()));
  clip_bottom_ = std::min(height_ * fine, sample(box.bottom()));
}

void Canvas::set_sample(int column, int row, Colour colour) {
  if (column >= clip_left_ && column < clip_right_ && row >= clip_top_ && row < clip_bottom_)
    at(column, row) = colour;
}

void Canvas::fill(std::span<const Point> polygon, Colour colour) {
  if (polygon.size() < 3)
    return;
  std::vector<Point> scaled(polygon.begin(), polygon.end());
  for (Point& p : scaled)
    p = {p.x * fine, p.y * fine};
  for_each_span(scaled, width_ * fine, height_ * fine, [&](int row, int first, int end) {
    if (row < clip_top_ || row >= clip_bottom_)
      return;
    for (int column = std::max(first, clip_left_); column < std::min(end, clip_right_); ++column)
      at(column, row) = colour;
  });
}

void Canvas::fill(const Box& box, Colour colour) {
  fill(std::array<Point, 4>{{{box.x, box.y},
                             {box.right(), box.y},
                             {box.right(), box.bottom()},
                             {box.x, box.bottom()}}},
       colour);
}

void Canvas::frame(const Box& box, double line_width, Colour colour) {
  const double w = line_width, h = w / 2;
  fill(Box{box.x - h, box.y - h, box.width + w, w}, colour);
  fill(Box{box.x - h, box.bottom() - h, box.width + w, w}, colour);
  fill(Box{box.x - h, box.y - h, w, box.height + w}, colour);
  fill(Box{box.right() - h, box.y - h, w, box.height + w}, colour);
}

void Canvas::line(Point a, Point b, double line_width, Colour colour) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (!(length > 0))
    return;
  const double nx = -dy / length * line_width / 2, ny = dx / length * line_width / 2;
  fill(
      std::array<Point, 4>{
          {{a.x + nx, a.y + ny}, {b.x + nx, b.y + ny}, {b.x - nx, b.y - ny}, {a.x - nx, a.y - ny}}},
      colour);
}

void Canvas::polyline(std::span<const Point> points, double line_width, Colour colour) {
  std::array<Point, 8> joint;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (p > 0)
      line(points[p - 1], points[p], line_width, colour);
    for (std::size_t v = 0; v < joint.size(); ++v) {
      const double angle = std::numbers::pi / 4 * (static_cast<double>(v) + 0.5);
      joint[v] = {points[p].x + line_width / 2 * std::cos(angle),
                  points[p].y + line_width / 2 * std::sin(angle)};
    }
    fill(joint, colour);
  }
}

void Canvas::text(Point at_pixel, const std::string& utf8, const TextStyle& style) {
  const Glyphs flat = render(utf8, style), glyphs = style.upright ? turned_upright(flat) : flat;
  const double shift_x = style.x == AlignX::left ? 0 : style.x == AlignX::centre ? 0.5 : 1;
  const double shift_y = style.y == AlignY::top ? 0 : style.y == AlignY::middle ? 0.5 : 1;
  const int left = static_cast<int>(std::lround(at_pixel.x * fine - shift_x * glyphs.width));
  const int top = static_cast<int>(std::lround(at_pixel.y * fine - shift_y * glyphs.height));
  for (int row = std::max(0, -top); row < glyphs.height && top + row < height_ * fine; ++row)
    for (int column = std::max(0, -left); column < glyphs.width && left + column < width_ * fine;
         ++column) {
      Colour& sample = at(left + column, top + row);
      const int opacity = glyphs.at(column, row);
      sample = {mix(sample.r, style.colour.r, opacity),
                mix(sample.g, style.colour.g, opacity),
                mix(sample.b, style.colour.b, opacity)};
    }
}

double Canvas::text_width(const std::string& utf8, const TextStyle& style) {
  return static_cast<double>(render(utf8, style).width) / fine;
}

void Canvas::save_png(const std::filesystem::path& path) const {
  vtkNew<vtkImageData> image;
  image->SetDimensions(width_, height_, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t stride = static_cast<std::size_t>(width_ * fine);
  for (int y = 0; y < height_; ++y) {
    auto* out = static_cast<std::uint8_t*>(image->GetScalarPointer(0, height_ - 1 - y, 0));
    for (int x = 0; x < width_; ++x) {
      int r = 0, g = 0, b = 0;
      for (int sy = 0; sy < fine; ++sy)
        for (int sx = 0; sx < fine; ++sx) {
          const Colour& s = samples_[static_cast<std::size_t>(y * fine + sy) * stride +
                                     static_cast<std::size_t>(x * fine + sx)];
          r += s.r, g += s.g, b += s.b;
        }
      for (int sum : {r, g, b})
        *out++ = static_cast<std::uint8_t>((sum + fine * fine / 2) / (fine * fine));
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw Error(fmt::format("{}: cannot be written. Is the folder writable and the disc not full?",
                            path.string()));
}

} // namespace ballast::post
