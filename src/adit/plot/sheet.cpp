#include "adit/plot/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/io/atomic_file.hpp"
#include "adit/plot/layout.hpp"
#include "adit/plot/painter.hpp"
#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

void draw_scale_bar(Painter& painter, const Vector2d& left, double points_per_metre, double width) {
  constexpr double kEnd = 2.2;  // points, half the height of the ends
  const Stroke bar{kInk, 0.8};
  const double metres = scale_bar_length(points_per_metre, width);
  const Vector2d right = left + Vector2d(metres * points_per_metre, 0.0);
  painter.line(left, right, bar);
  for (const Vector2d& end : {left, right}) {
    painter.line(end - Vector2d(0.0, kEnd), end + Vector2d(0.0, kEnd), bar);
  }
  painter.text(right + Vector2d(4.0, 0.0), tick_text(metres, metres) + " m", kLegendText, {1, 0});
}

void draw_entry(Painter& painter, const LegendEntry& entry, const Vector2d& left) {
  const Vector2d right = left + Vector2d(sample_width(entry), 0.0);
  const Vector2d middle = 0.5 * (left + right);
  if (entry.area) {
    const Vector2d half(0.5 * sample_width(entry), 3.5);
    const Vector2d flipped(half.x(), -half.y());
    painter.polygon(std::array{Vector2d(middle - half), Vector2d(middle + flipped),
                               Vector2d(middle + half), Vector2d(middle - flipped)},
                    *entry.area, std::nullopt);
  }
  if (entry.line) painter.line(left, right, *entry.line);
  if (entry.arrow) {
    painter.arrow(middle - Vector2d(0.5 * entry.arrow->length, 0.0), 0.0, *entry.arrow);
  }
  if (entry.mark) painter.mark(middle, *entry.mark);
  painter.text(right + Vector2d(4.0, 0.0), entry.text, kLegendText, {1, 0});
}

void draw_panel(Painter& painter, const PlacedPanel& placed, const PictureOptions& options) {
  const auto* canvas = std::get_if<Canvas>(placed.panel);
  const std::string& caption = canvas ? canvas->caption() : std::get<Chart>(*placed.panel).caption;
  if (!caption.empty()) {
    const double left = placed.body.min.x();
    painter.text({left, placed.body.min.y() - 5.0}, caption, kCaptionText, {1, -1});
  }
  if (!canvas) return std::get<Chart>(*placed.panel).draw(painter, placed.body);
  canvas->draw(painter, placed.body, options.axes);
  if (!options.scale_bar || !placed.bar_y) return;
  draw_scale_bar(painter, {placed.body.min.x(), *placed.bar_y}, canvas->scale_in(placed.body),
                 placed.body.size.x());
}

Result<void> check(const PictureOptions& options) {
  const auto in_range = [](double value, double least, double most) {
    return value >= least && value <= most;  // false for not-a-number
  };
  if (!in_range(options.width_mm, 20.0, 2000.0)) return fail("width_mm must lie in 20 to 2000");
  if (!in_range(options.max_height_mm, 20.0, 2000.0)) {
    return fail("max_height_mm must lie in 20 to 2000");
  }
  if (!in_range(options.dots_per_inch, 20.0, 2400.0)) {
    return fail("dots_per_inch must lie in 20 to 2400");
  }
  return {};
}

}  // namespace

Result<void> Sheet::write(const std::string& path) const {
  const Result<PictureFormat> format = picture_format(path);
  if (!format) return tl::unexpected(format.error());
  if (Result<void> fine = check(options_); !fine) return fine;

  Painter ruler(PictureFormat::png, Vector2d(1.0, 1.0), 72.0);
  const PageLayout page = lay_out(rows_, legend_, options_, ruler);
  Painter painter(*format, page.size, options_.dots_per_inch);
  if (!options_.title.empty()) {
    TextStyle style = kTitleText;
    const double width = painter.text_size(options_.title, style).x();
    style.size *= std::min(1.0, (page.size.x() - 2.0 * kPageMargin) / std::max(width, 1.0));
    painter.text({kPageMargin, page.title_y}, options_.title, style, {1, 0});
  }
  for (const PlacedPanel& panel : page.panels) draw_panel(painter, panel, options_);
  for (const PlacedEntry& entry : page.footer) {
    if (entry.entry) {
      draw_entry(painter, *entry.entry, entry.at);
    } else {
      const PlacedPanel& panel = page.panels.front();
      draw_scale_bar(painter, entry.at, std::get<Canvas>(*panel.panel).scale_in(panel.body),
                     page.size.x() - 2.0 * kPageMargin);
    }
  }
  Result<std::string> bytes = painter.finish();
  if (!bytes) return fail(bytes.error().message, path);
  return write_file(path, *bytes);
}

}  // namespace adit
