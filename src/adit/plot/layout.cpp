#include "adit/plot/layout.hpp"

#include <algorithm>
#include <cmath>

#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kNarrowest = 60.0 * kPointsPerMm;  // a page has room for a legend
constexpr double kPanelGap = 14.0;
constexpr double kCaptionHeight = 13.0;
constexpr double kBarHeight = 15.0;
constexpr double kTitleHeight = 16.0;
constexpr double kFooterGap = 7.0;
constexpr double kLegendLine = 12.0;
constexpr double kLegendGap = 13.0;
constexpr double kAxesBottom = 14.0;

/// What a panel needs beside its body.
struct Surround {
  double left = 0.0;
  double above = 0.0;
  double below = 0.0;
};

class Arranger {
 public:
  Arranger(const PictureOptions& options, Painter& ruler, bool bars_in_panels)
      : options_(options), ruler_(ruler), bars_in_panels_(bars_in_panels) {}

  Surround surround(const Panel& panel) const {
    Surround around;
    const auto* canvas = std::get_if<Canvas>(&panel);
    const std::string& caption = canvas ? canvas->caption() : std::get<Chart>(panel).caption;
    if (!caption.empty()) around.above = kCaptionHeight;
    if (!canvas) return around;
    if (options_.axes) {
      around.left = axes_width(canvas->view());
      around.below = kAxesBottom;
    }
    if (bars_in_panels_) around.below += kBarHeight;
    return around;
  }

  /// Height of the body at this width of the whole panel.
  double body_height(const Panel& panel, double width) const {
    const double inner = std::max(1.0, width - surround(panel).left);
    const auto* canvas = std::get_if<Canvas>(&panel);
    if (!canvas) return inner * std::get<Chart>(panel).height_ratio;
    const Vector2d size = canvas->view().size();
    return inner * size.y() / size.x();
  }

 private:
  /// Room for the widest number on the y axis; any round number of the range will do.
  double axes_width(const Box& view) const {
    const double step = round_down(0.2 * view.size().y());
    const double low = ruler_.text_size(tick_text(view.min.y(), step), kAxisText).x();
    const double high = ruler_.text_size(tick_text(view.max.y(), step), kAxisText).x();
    return std::max(low, high) + 5.0;
  }

  const PictureOptions& options_;
  Painter& ruler_;
  bool bars_in_panels_;
};

/// Entries from left to right, in as many lines as they need; returns the lower end.
double flow_footer(PageLayout& page, const std::vector<LegendEntry>& legend,
                   std::optional<double> bar_width, double top, Painter& ruler) {
  const double right = page.size.x() - kPageMargin;
  Vector2d at(kPageMargin, top + 0.5 * kLegendLine);
  const auto put = [&](const LegendEntry* entry, double width) {
    if (at.x() > kPageMargin && at.x() + width > right) at = {kPageMargin, at.y() + kLegendLine};
    page.footer.push_back({entry, at});
    at.x() += width + kLegendGap;
  };
  if (bar_width) put(nullptr, *bar_width);
  for (const LegendEntry& entry : legend) {
    put(&entry, sample_width(entry) + 4.0 + ruler.text_size(entry.text, kLegendText).x());
  }
  return page.footer.empty() ? top - kFooterGap : at.y() + 0.5 * kLegendLine;
}

const Canvas* only_canvas(const std::vector<std::vector<Panel>>& rows) {
  if (rows.size() != 1 || rows.front().size() != 1) return nullptr;
  return std::get_if<Canvas>(&rows.front().front());
}

/// Places one row and returns its lower end.
double place_row(PageLayout& page, const std::vector<Panel>& row, const Arranger& arranger,
                 double top, double content_width, double max_height) {
  if (row.empty()) return top;
  const auto count = static_cast<double>(row.size());
  const double width = std::max(1.0, (content_width - kPanelGap * (count - 1.0)) / count);
  Surround most;
  double height = 0.0;
  for (const Panel& panel : row) {
    const Surround around = arranger.surround(panel);
    most.above = std::max(most.above, around.above);
    most.below = std::max(most.below, around.below);
    height = std::max(height, arranger.body_height(panel, width));
  }
  height = std::min(height, max_height);
  double left = kPageMargin;
  for (const Panel& panel : row) {
    const Surround around = arranger.surround(panel);
    PlacedPanel placed;
    placed.panel = &panel;
    placed.body = {{left + around.left, top + most.above}, {width - around.left, height}};
    placed.bar_y = top + most.above + height + most.below - 0.5 * kBarHeight + 3.0;
    page.panels.push_back(placed);
    left += width + kPanelGap;
  }
  return top + most.above + height + most.below;
}

}  // namespace

double sample_width(const LegendEntry& entry) {
  double width = 8.0;
  if (entry.mark) width = std::max(width, entry.mark->size + 1.0);
  if (entry.arrow) width = std::max(width, entry.arrow->length + 2.0);
  return entry.line || entry.area ? std::max(width, 20.0) : width;
}

double scale_bar_length(double points_per_metre, double width) {
  return round_down(0.24 * width / points_per_metre);
}

PageLayout lay_out(const std::vector<std::vector<Panel>>& rows,
                   const std::vector<LegendEntry>& legend, const PictureOptions& options,
                   Painter& ruler) {
  const Canvas* single = only_canvas(rows);
  const Arranger arranger(options, ruler, options.scale_bar && !single);
  const double max_height = options.max_height_mm * kPointsPerMm;
  PageLayout page;
  page.size.x() = options.width_mm * kPointsPerMm;
  if (single) {
    // A high picture that is scaled down leaves nothing to show beside it.
    const Panel& panel = rows.front().front();
    const double content = page.size.x() - 2.0 * kPageMargin;
    const double height = arranger.body_height(panel, content);
    const double used = content * std::min(1.0, max_height / height) + 2.0 * kPageMargin;
    page.size.x() = std::min(page.size.x(), std::max(used, kNarrowest));
  }
  const double content = page.size.x() - 2.0 * kPageMargin;
  double y = kPageMargin;
  page.title_y = y + 5.0;
  if (!options.title.empty()) y += kTitleHeight;
  for (const std::vector<Panel>& row : rows) {
    if (&row != &rows.front()) y += kPanelGap;
    y = place_row(page, row, arranger, y, content, max_height);
  }
  std::optional<double> bar;
  if (single && options.scale_bar) {
    page.panels.front().bar_y.reset();
    const double scale = single->scale_in(page.panels.front().body);
    const double length = scale_bar_length(scale, content);
    bar = length * scale + 4.0 + ruler.text_size(tick_text(length, length) + " m", kLegendText).x();
  }
  const std::vector<LegendEntry> none;
  const auto& shown = options.legend ? legend : none;
  page.size.y() = flow_footer(page, shown, bar, y + kFooterGap, ruler) + kPageMargin;
  return page;
}

}  // namespace adit
