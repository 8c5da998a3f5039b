#include "post/field_pictures.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <ostream>
#include <set>

#include "post/field_scale.hpp"
#include "post/section_raster.hpp"

namespace ballast::post {
namespace {

constexpr double left_margin = 118, header = 132, footer = 92, panel_header = 40;

struct Panel {
  Field field;
  std::string title;
  std::optional<FieldScale> scale; // none for the materials
};

/// What all pictures of one view share.
struct Series {
  std::string title, geometry;
  bool mirrored;
  std::vector<std::string> material_names;
  std::vector<Colour> material_colours;
  std::vector<int> materials; // those that occur
  std::vector<Panel> panels;
  ScaledUnit time_unit;
  int time_decimals;
  const std::string& name(int m) const { return material_names[static_cast<std::size_t>(m)]; }
  Colour colour(int m) const { return material_colours[static_cast<std::size_t>(m)]; }
};

/// Panels side by side for tall views, one below the other for wide ones; equal scales on both
/// axes.
struct Layout {
  bool side_by_side;
  double plot_width, plot_height;
  double legend, bar; // room right of the plots: for the legend, for a colour bar
  bool has_legend;
  bool to_scale;
  int width, height; // of the canvas
  Box box(std::size_t panel) const {
    const double k = static_cast<double>(panel),
                 legend_room = has_legend && panel > 0 ? legend - bar : 0;
    if (!side_by_side)
      return {
          left_margin, header + k * (panel_header + plot_height + footer), plot_width, plot_height};
    return {left_margin + k * (left_margin + plot_width + bar) + legend_room,
            header,
            plot_width,
            plot_height};
  }
};

Layout make_layout(const Series& series, const View& view) {
  Layout layout{};
  layout.side_by_side = view.width() < 1.6 * view.height();
  const double most_width = layout.side_by_side ? 500 : 1240,
               most_height = layout.side_by_side ? 940 : 450;
  const double scale = std::min(most_width / view.width(), most_height / view.height());
  layout.plot_width = std::round(std::max(80.0, view.width() * scale));
  layout.plot_height = std::round(std::max(80.0, view.height() * scale));
  layout.to_scale = std::min(view.width(), view.height()) * scale >= 79;
  layout.has_legend = !series.materials.empty();
  layout.legend = layout.bar = 124;
  for (int m : series.materials)
    layout.legend = std::max(layout.legend, 70 + Canvas::text_width(series.name(m), {.size = 20}));
  const double n = static_cast<double>(series.panels.size());
  const double tall = panel_header + layout.plot_height + footer;
  const double missing = 1200 - n * (left_margin + layout.plot_width + layout.bar);
  if (layout.side_by_side && missing > 0)
    layout.legend += missing / n, layout.bar += missing / n;
  const double right = layout.box(layout.side_by_side ? series.panels.size() - 1 : 0).right();
  const double room =
      layout.has_legend && (!layout.side_by_side || n < 2) ? layout.legend : layout.bar;
  layout.width = static_cast<int>(std::ceil(std::max(1200.0, right + room)));
  layout.height =
      static_cast<int>(std::ceil(header - panel_header + (layout.side_by_side ? 1 : n) * tall));
  return layout;
}

void draw_legend(Canvas& canvas, const Box& box, const Series& series) {
  const double rows = static_cast<double>(std::max<std::size_t>(series.materials.size(), 1));
  const double step = std::clamp(box.height / rows, 20.0, 34.0), size = std::min(22.0, step - 4);
  double y = box.y;
  for (int m : series.materials) {
    const std::string& name = series.name(m);
    const Box patch{box.right() + 20, y, size, size};
    canvas.fill(patch, series.colour(m));
    canvas.frame(patch, 1, grey);
    canvas.text({patch.right() + 10, y + size / 2}, name, {.size = std::min(20.0, size)});
    y += step;
  }
}

void draw_colour_bar(Canvas& canvas, const Box& box, const FieldScale& scale) {
  const double tip = 16, width = 22, length = box.height;
  const double lower_tip = scale.below ? tip : 0, upper_tip = scale.above ? tip : 0;
  const Box bar{box.right() + 20, box.y + upper_tip, width, length - upper_tip - lower_tip};
  const int steps = static_cast<int>(bar.height * Canvas::fine);
  for (int s = 0; s < steps; ++s)
    canvas.fill(Box{bar.x, bar.y + bar.height * s / steps, width, bar.height / steps},
                scale.map(1 - (s + 0.5) / steps));
  const double middle = bar.x + width / 2;
  const Point upper{middle, bar.y - tip}, lower{middle, bar.bottom() + tip};
  if (scale.above)
    canvas.fill(std::array<Point, 3>{{{bar.x, bar.y}, upper, {bar.right(), bar.y}}}, scale.map(1));
  if (scale.below)
    canvas.fill(std::array<Point, 3>{{{bar.x, bar.bottom()}, lower, {bar.right(), bar.bottom()}}},
                scale.map(0));
  std::vector<Point> outline{{bar.x, bar.y}};
  if (scale.above)
    outline.push_back(upper);
  outline.push_back({bar.right(), bar.y});
  outline.push_back({bar.right(), bar.bottom()});
  if (scale.below)
    outline.push_back(lower);
  outline.push_back({bar.x, bar.bottom()});
  outline.push_back(outline.front());
  canvas.polyline(outline, 1.2, black);
  const Ticks ticks = round_ticks(scale.low / scale.unit.scale,
                                  scale.high / scale.unit.scale,
                                  std::clamp(bar.height / 80, 2.0, 6.0));
  for (std::size_t k = 0; k < ticks.values.size(); ++k) {
    const double fraction =
        (ticks.values[k] * scale.unit.scale - scale.low) / (scale.high - scale.low);
    const double y = bar.bottom() - fraction * bar.height;
    canvas.line({bar.right(), y}, {bar.right() + 6, y}, 1.5, black);
    canvas.text({bar.right() + 11, y}, ticks.label(k), {.size = 20});
  }
}

Colour sample_colour(const SectionRaster& raster,
                     std::size_t s,
                     const Series& series,
                     const Panel& panel) {
  const int m = raster.material[s];
  if (m == SectionCell::none)
    return white;
  if (panel.field == Field::material)
    return m < 0 ? light_grey : series.colour(m);
  const float value = panel.field == Field::pressure ? raster.pressure[s] : panel.field == Field::damage ? raster.damage[s] : raster.speed[s];
  if (!std::isfinite(value))
    return light_grey;
  const FieldScale& scale = *panel.scale;
  return scale.map((static_cast<double>(value) - scale.low) / (scale.high - scale.low));
}

/// Interfaces: dark on the pale maps, white on viridis.
Colour interface_colour(Field field) {
  return field == Field::speed ? Colour{240, 240, 240} : Colour{45, 45, 50};
}

void paint(Canvas& canvas,
           const SectionRaster& raster,
           const std::vector<bool>& interfaces,
           const Series& series,
           const Panel& panel) {
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column) {
      const std::size_t s = raster.index(column, row);
      const Colour colour = sample_colour(raster, s, series, panel);
      canvas.set_sample(raster.left + column,
                        raster.top + row,
                        interfaces[s] ? interface_colour(panel.field) : colour);
    }
}

void draw_panel(Canvas& canvas,
                const Series& series,
                const Panel& panel,
                const Layout& layout,
                const PlotArea& area,
                SectionRaster& raster,
                const std::vector<bool>& interfaces) {
  raster.left = static_cast<int>(std::lround(area.box.x * Canvas::fine));
  raster.top = static_cast<int>(std::lround(area.box.y * Canvas::fine));
  paint(canvas, raster, interfaces, series, panel);
  PlotArea in_mm = area;
  in_mm.x = {area.x.low * 1e3, area.x.high * 1e3};
  in_mm.y = {area.y.low * 1e3, area.y.high * 1e3};
  const bool axisymmetric = series.geometry == "axisymmetric", solid = series.geometry == "3d";
  draw_axes(canvas,
            in_mm,
            axisymmetric ? "r [mm]" : "x [mm]",
            axisymmetric || solid ? "z [mm]" : "y [mm]",
            false);
  const std::string note = layout.to_scale ? "" : " (not to scale)";
  canvas.text({area.box.x, area.box.y - 12},
              panel.title + note,
              {.size = 24, .bold = true, .y = AlignY::bottom});
  if (panel.scale)
    draw_colour_bar(canvas, area.box, *panel.scale);
  else
    draw_legend(canvas, area.box, series);
}

void draw_picture(const Section& section,
                  const Series& series,
                  const View& view,
                  const std::filesystem::path& path) {
  const Layout layout = make_layout(series, view);
  Canvas canvas(layout.width, layout.height);
  PlotArea area{layout.box(0), view.x, view.y};
  SectionRaster raster = sample(section, area, series.mirrored);
  const std::vector<bool> interfaces = interface_samples(raster);
  for (std::size_t k = 0; k < series.panels.size(); ++k) {
    area.box = layout.box(k);
    draw_panel(canvas, series, series.panels[k], layout, area, raster, interfaces);
  }
  const std::string time = fmt::format("t = {:.{}f} {}",
                                       section.time / series.time_unit.scale,
                                       series.time_decimals,
                                       series.time_unit.name);
  const double right = layout.width - 28.0;
  canvas.text({right, 38}, time, {.size = 30, .bold = true, .x = AlignX::right});
  canvas.text({left_margin, 38}, series.title, {.size = 30});
  canvas.save_png(path);
}

Series make_series(const std::vector<Section>& sections, const std::string& title) {
  Series series{.title = title,
                .geometry = sections.front().geometry,
                .mirrored = sections.front().mirrored,
                .material_names = {},
                .material_colours = {},
                .materials = {},
                .panels = {},
                .time_unit = scaled_unit("s", sections.back().time),
                .time_decimals = 2};
  std::set<int> seen;
  for (const Section& section : sections) {
    if (section.material_names.size() > series.material_names.size())
      series.material_names = section.material_names;
    for (const SectionBlock& block : section.blocks) {
      for (const SectionCell& cell : block.cells)
        if (cell.material >= 0)
          seen.insert(cell.material);
      for (const SectionPolygon& polygon : block.polygons)
        seen.insert(polygon.material);
    }
  }
  series.materials.assign(seen.begin(), seen.end());
  for (int m = static_cast<int>(series.material_names.size()); !seen.empty() && m <= *seen.rbegin();
       ++m)
    series.material_names.push_back(fmt::format("material {}", m));
  series.material_colours = material_colours(series.material_names);
  const std::string plane = series.geometry == "3d" ? ", section y = 0" : "";
  if (!seen.empty())
    series.panels.push_back({Field::material, "Materials" + plane, std::nullopt});
  if (const auto scale = field_scale(sections, Field::pressure))
    series.panels.push_back(
        {Field::pressure, "Pressure [" + scale->unit.name + "]" + plane, scale});
  if (const auto scale = field_scale(sections, Field::damage))
    series.panels.push_back({Field::damage, "Damage of the fabric" + plane, scale});
  if (const auto scale = field_scale(sections, Field::speed))
    series.panels.push_back({Field::speed, "Speed [m/s]" + plane, scale});
  return series;
}

} // namespace

int draw_field_pictures(const std::vector<Section>& sections,
                        const std::string& title,
                        const std::filesystem::path& folder,
                        std::ostream& log,
                        const std::optional<View>& asked) {
  const Series series = make_series(sections, title);
  if (series.panels.empty()) {
    log << "no picture of the fields: the dumps hold none of material, pressure, speed\n";
    return 0;
  }
  const View whole = whole_view(sections, series.mirrored);
  std::optional<View> close = asked;
  if (!close && series.panels.back().field == Field::speed)
    close = close_up(sections, whole, series.mirrored, series.panels.back().scale->high);
  int pictures = 0;
  const auto draw =
      [&](const Section& section, const View& view, const char* kind, std::size_t number) {
        const std::filesystem::path path = folder / fmt::format("{}_{:02d}.png", kind, number);
        draw_picture(section, series, view, path);
        log << path.string() << '\n';
        ++pictures;
      };
  for (std::size_t k = 0; k < sections.size(); ++k) {
    draw(sections[k], whole, "fields", k + 1);
    if (close)
      draw(sections[k], *close, "closeup", k + 1);
  }
  return pictures;
}

} // namespace ballast::post
