#include "adit/plot/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/map/box.hpp"
#include "adit/plot/labels.hpp"
#include "adit/plot/painter.hpp"
#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

constexpr double kTick = 3.0;       // points
constexpr double kTextGap = 3.0;    // points
constexpr double kHeadroom = 0.06;  // of the range of y

/// From values to the page; y as its logarithm where the axis is logarithmic.
class Scale {
 public:
  Scale(const Chart& chart, const PageRect& plot) : log_y_(chart.log_y), plot_(plot) {
    for (const ChartSeries& series : chart.series) {
      for (const Vector2d& p : series.points) extend(p);
    }
    const bool has_points = !box_.is_empty();
    if (!has_points) box_ = {Vector2d(0.0, 0.0), Vector2d(1.0, 1.0)};
    for (const ChartLevel& level : chart.levels) extend({box_.min.x(), level.value});
    for (const ChartBand& band : chart.bands) widen(band);
    if (has_points && !log_y_ && chart.from_zero) extend({box_.min.x(), 0.0});
    const bool flat = !(box_.max.y() > box_.min.y());
    if (!(box_.max.x() > box_.min.x()))
      box_ = {box_.min - Vector2d(0.5, 0), box_.max + Vector2d(0.5, 0)};
    if (flat) box_ = {box_.min - Vector2d(0, 0.5), box_.max + Vector2d(0, 0.5)};
    const double room = kHeadroom * box_.size().y();
    const bool stands_on_zero = !log_y_ && box_.min.y() == 0.0;
    box_.max.y() += room;
    if (!stands_on_zero) box_.min.y() -= room;
  }

  Vector2d operator()(const Vector2d& p) const {
    const Vector2d fraction = (Vector2d(p.x(), level(p.y())) - box_.min).cwiseQuotient(box_.size());
    return {plot_.min.x() + fraction.x() * plot_.size.x(),
            plot_.max().y() - fraction.y() * plot_.size.y()};
  }
  const Box& box() const { return box_; }

  std::vector<double> y_ticks(int most) const {
    if (!log_y_) return ticks(box_.min.y(), box_.max.y(), most);
    return decade_ticks(std::pow(10.0, box_.min.y()), std::pow(10.0, box_.max.y()), most);
  }

 private:
  double level(double y) const { return log_y_ ? std::log10(y) : y; }
  void extend(const Vector2d& p) {
    const Vector2d value(p.x(), level(p.y()));
    if (value.allFinite()) box_.extend(value);
  }

  void widen(const ChartBand& band) {
    for (const double x : {band.from, band.to}) {
      if (std::isfinite(x)) box_.extend({x, box_.min.y()});
    }
  }

  bool log_y_;
  PageRect plot_;
  Box box_;
};

double step_of(const std::vector<double>& values) {
  return values.size() > 1 ? values[1] - values[0] : 1.0;
}

std::string y_text(const Chart& chart, const std::vector<double>& values, double value) {
  return tick_text(value, chart.log_y ? value : step_of(values));
}

void draw_axes(Painter& painter, const Chart& chart, const Scale& scale, const PageRect& plot) {
  const Stroke thin{kInk, 0.6};
  const Vector2d corner(plot.min.x(), plot.max().y());
  painter.line(corner, plot.min, thin);
  painter.line(corner, plot.max(), thin);
  const int most = std::max(2, static_cast<int>(plot.size.x() / 45.0));
  const std::vector<double> xs = ticks(scale.box().min.x(), scale.box().max.x(), most);
  for (const double x : xs) {
    const Vector2d at(scale({x, 1.0}).x(), corner.y());
    painter.line(at, at + Vector2d(0.0, kTick), thin);
    painter.text(at + Vector2d(0.0, kTick + kTextGap), tick_text(x, step_of(xs)), kAxisText,
                 {0, 1});
  }
  const std::vector<double> ys = scale.y_ticks(std::max(2, static_cast<int>(plot.size.y() / 22.0)));
  for (const double y : ys) {
    const Vector2d at(corner.x(), scale({0.0, y}).y());
    painter.line(at, at - Vector2d(kTick, 0.0), thin);
    painter.text(at - Vector2d(kTick + kTextGap, 0.0), y_text(chart, ys, y), kAxisText, {-1, 0});
  }
}

void draw_band(Painter& painter, const ChartBand& band, const Scale& scale, const PageRect& plot) {
  constexpr double kNarrowest = 0.6;  // points; a single value of many must still be seen
  const double from = scale({band.from, 1.0}).x();
  const double to = scale({band.to, 1.0}).x();
  if (!std::isfinite(from) || !std::isfinite(to)) return;
  const double half = 0.5 * std::max(to - from, kNarrowest);
  const double left = std::max(plot.min.x(), 0.5 * (from + to) - half);
  const double right = std::min(plot.max().x(), 0.5 * (from + to) + half);
  painter.polygon(std::array{Vector2d(left, plot.min.y()), Vector2d(right, plot.min.y()),
                             Vector2d(right, plot.max().y()), Vector2d(left, plot.max().y())},
                  band.fill, std::nullopt);
}

void draw_series(Painter& painter, const ChartSeries& series, const Scale& scale,
                 const PageRect& plot, LabelPlacer& placer) {
  PathPoints path;
  path.begin();
  for (const Vector2d& p : series.points) path.points.push_back(scale(p));
  // The points stand on the page already: the same reduction with a mapping that changes nothing.
  for (Vector2d& p : path.points) p.y() = -p.y();
  const PathPoints reduced = to_page(path, WorldToPage{}, plot.padded(0.5));
  if (series.stroke) {
    painter.stroke(reduced, *series.stroke);
    placer.occupy(reduced, series.stroke->width);
  }
  if (!series.mark) return;
  for (const Vector2d& value : series.points) {
    const Vector2d p = scale(value);
    if (p.allFinite()) painter.mark(p, *series.mark);
  }
}

}  // namespace

void Chart::draw(Painter& painter, const PageRect& area) const {
  const Vector2d line = painter.text_size("0", kAxisText);
  // The width of the numbers on the left depends on the height, the height not on the width.
  const double bottom = kTick + kTextGap + 2.0 * line.y() + 5.0;
  PageRect plot{area.min + Vector2d(0.0, 2.0), area.size - Vector2d(4.0, bottom + 2.0)};
  const Scale tall(*this, plot);
  const std::vector<double> ys = tall.y_ticks(std::max(2, static_cast<int>(plot.size.y() / 22.0)));
  double widest = 0.0;
  for (const double y : ys) {
    widest = std::max(widest, painter.text_size(y_text(*this, ys, y), kAxisText).x());
  }
  const double left = widest + kTick + kTextGap + line.y() + 7.0;
  plot = {plot.min + Vector2d(left, 0.0), plot.size - Vector2d(left, 0.0)};

  const Scale scale(*this, plot);
  LabelPlacer placer(plot);
  for (const ChartBand& band : bands) draw_band(painter, band, scale, plot);
  for (const ChartLevel& level : levels) {
    const double y = scale({0.0, level.value}).y();
    if (std::isfinite(y)) painter.line({plot.min.x(), y}, {plot.max().x(), y}, level.stroke);
  }
  for (const ChartSeries& one : series) draw_series(painter, one, scale, plot, placer);
  draw_axes(painter, *this, scale, plot);
  for (const ChartLabel& label : labels) {
    const Vector2d at = scale(label.at);
    if (!at.allFinite()) continue;
    const Vector2d size = painter.text_size(label.words, label.style);
    painter.text(placer.place(at, 3.5, size).box.center(), label.words, label.style, {0, 0});
  }
  painter.text({plot.center().x(), area.max().y()}, x_label, kAxisText, {0, -1});
  painter.text_upwards({area.min.x() + line.y(), plot.center().y()}, y_label, kAxisText);
}

}  // namespace adit
