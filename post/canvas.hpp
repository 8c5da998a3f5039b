// Canvas: a small software picture. Polygons, lines and text are drawn on a grid `fine` times finer
// than the picture and averaged on saving, which smooths every edge. No OpenGL and no X server: a
// report can be made on any node. Text comes from VTK's FreeType with its built-in Arial.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ballast::post {

struct Colour {
  std::uint8_t r, g, b;
};
inline constexpr Colour black{20, 20, 24}, grey{110, 110, 116}, light_grey{225, 225, 228},
    white{255, 255, 255};

/// Pixels from the top left corner, y down.
struct Point {
  double x, y;
};

struct Box {
  double x, y, width, height;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class AlignX { left, centre, right };
enum class AlignY { top, middle, bottom };

struct TextStyle {
  double size = 20; // height of the font, pixels
  bool bold = false;
  AlignX x = AlignX::left;
  AlignY y = AlignY::middle;
  bool upright = false; // reads from bottom to top
  Colour colour = black;
};

/// Calls span(row, first, last) for the samples (column + 1/2, row + 1/2) inside `polygon`
/// (even-odd rule), clipped to width x height. Neighbours that share an edge share no sample and
/// leave none out.
template <class Span>
void for_each_span(std::span<const Point> polygon, int width, int height, Span&& span) {
  constexpr std::size_t most = 64;
  double low = polygon[0].y, high = low, crossing[most];
  for (const Point& p : polygon)
    low = std::fmin(low, p.y), high = std::fmax(high, p.y);
  if (!(low < height && high > 0))
    return;
  const int first_row = static_cast<int>(std::ceil(std::fmax(low, 0.0) - 0.5));
  const int end_row = static_cast<int>(std::ceil(std::fmin(high, height) - 0.5));
  for (int row = first_row < 0 ? 0 : first_row; row < end_row; ++row) {
    const double y = row + 0.5;
    std::size_t n = 0;
    for (std::size_t v = 0; v < polygon.size(); ++v) {
      const Point &a = polygon[v], &b = polygon[v + 1 == polygon.size() ? 0 : v + 1];
      if ((a.y <= y) == (b.y <= y) || n == most)
        continue;
      double x = a.y < b.y ? a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)
                           : b.x + (y - b.y) / (a.y - b.y) * (a.x - b.x);
      std::size_t at = n++; // insertion sort: two crossings nearly always
      for (; at > 0 && crossing[at - 1] > x; --at)
        crossing[at] = crossing[at - 1];
      crossing[at] = x;
    }
    for (std::size_t c = 0; c + 1 < n; c += 2) {
      const double left = std::fmax(crossing[c], 0.0), right = std::fmin(crossing[c + 1], width);
      if (left < right)
        span(
            row, static_cast<int>(std::ceil(left - 0.5)), static_cast<int>(std::ceil(right - 0.5)));
    }
  }
}

class Canvas {
public:
  static constexpr int fine = 3; // samples a pixel and axis

  Canvas(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  void fill(std::span<const Point> polygon, Colour colour);
  void fill(const Box& box, Colour colour);
  void frame(const Box& box, double line_width, Colour colour);
  void line(Point a, Point b, double line_width, Colour colour);
  /// A chain with round joints; points outside `clip` are cut off at its edge.
  void polyline(std::span<const Point> points, double line_width, Colour colour);
  void text(Point at, const std::string& utf8, const TextStyle& style);
  static double text_width(const std::string& utf8, const TextStyle& style);

  /// Drawing outside `box` is dropped until unclip().
  void clip(const Box& box);
  void unclip();

  /// Sets one sample (column and row on the fine grid).
  void set_sample(int column, int row, Colour colour);

  /// Throws Error.
  void save_png(const std::filesystem::path& path) const;

private:
  Colour& at(int column, int row) {
    return samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ * fine) +
                    static_cast<std::size_t>(column)];
  }
  int width_, height_;
  int clip_left_, clip_top_, clip_right_, clip_bottom_;
  std::vector<Colour> samples_;
};

} // namespace ballast::post
