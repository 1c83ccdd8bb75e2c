#include "adit/plot/painter.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "adit/plot/utf8.hpp"

namespace adit {
namespace {

constexpr double kPointsPerInch = 72.0;
constexpr double kCapHeight = 0.72;  // of the font size

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  auto& out = *static_cast<std::string*>(bytes);
  for (unsigned int i = 0; i < length; ++i) out.push_back(static_cast<char>(data[i]));
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(PictureFormat format, const Vector2d& size, double pixels_per_point,
                              std::string* bytes) {
  switch (format) {
    case PictureFormat::svg: {
      cairo_surface_t* surface =
          cairo_svg_surface_create_for_stream(append, bytes, size.x(), size.y());
      cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
      return surface;
    }
    case PictureFormat::pdf: {
      cairo_surface_t* surface =
          cairo_pdf_surface_create_for_stream(append, bytes, size.x(), size.y());
      // A date of now would make each run's file another one.
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE,
                                     "2000-01-01T00:00:00Z");
      return surface;
    }
    case PictureFormat::png:
      break;
  }
  const Vector2d pixels = (size * pixels_per_point).cwiseMin(1e6);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                    static_cast<int>(std::ceil(pixels.x() - 1e-6)),
                                    static_cast<int>(std::ceil(pixels.y() - 1e-6)));
}

/// cairo numbers the surfaces of a process; without their numbers equal pictures are equal files.
void drop_surface_numbers(std::string& svg) {
  constexpr std::string_view kTag = "\"surface";
  for (std::size_t at = svg.find(kTag); at != std::string::npos; at = svg.find(kTag, at + 1)) {
    const std::size_t begin = at + kTag.size();
    std::size_t end = begin;
    while (end < svg.size() && svg[end] >= '0' && svg[end] <= '9') ++end;
    svg.replace(begin, end - begin, "0");
  }
}

}  // namespace

Result<PictureFormat> picture_format(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".svg") return PictureFormat::svg;
  if (ending == ".pdf") return PictureFormat::pdf;
  const std::string found = ending.empty() ? "no ending" : "'" + ending + "'";
  return fail("a picture's name ends in .png, .svg or .pdf; found " + found, path);
}

Painter::Painter(PictureFormat format, const Vector2d& size, double dots_per_inch)
    : format_(format), bytes_(std::make_unique<std::string>()) {
  const double scale = format == PictureFormat::png ? dots_per_inch / kPointsPerInch : 1.0;
  surface_.reset(make_surface(format, size, scale, bytes_.get()));
  cairo_.reset(cairo_create(surface_.get()));
  cairo_scale(cairo_.get(), scale, scale);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_font_options_t* font = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(font, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(font, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_antialias(font, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo_.get(), font);
  cairo_font_options_destroy(font);
  set_colour(kWhite);
  cairo_paint(cairo_.get());
}

void Painter::set_colour(const Colour& c) {
  cairo_set_source_rgba(cairo_.get(), c.red, c.green, c.blue, c.alpha);
}

void Painter::set_stroke(const Stroke& style) {
  set_colour(style.colour);
  cairo_set_line_width(cairo_.get(), style.width);
  if (style.dash == Dash::solid) {
    cairo_set_dash(cairo_.get(), nullptr, 0, 0.0);
    return;
  }
  // A dash of no length with round caps is a dot.
  const std::array<double, 2> pattern = style.dash == Dash::dotted
                                            ? std::array{0.0, 2.4 * style.width}
                                            : std::array{4.0 * style.width, 4.0 * style.width};
  cairo_set_dash(cairo_.get(), pattern.data(), static_cast<int>(pattern.size()), 0.0);
}

void Painter::set_font(const TextStyle& style) {
  // The name is an alias everywhere: fontconfig gives the metric equal that is installed.
  cairo_select_font_face(cairo_.get(), "Helvetica", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), style.size);
}

void Painter::stroke(const PathPoints& path, const Stroke& style) {
  constexpr std::size_t kBatch = 4096;  // cairo's time for one stroke grows faster than its length
  set_stroke(style);
  std::size_t pending = 0;
  for (std::size_t i = 0; i < path.count(); ++i) {
    const std::span<const Vector2d> part = path.part(i);
    if (part.empty()) continue;
    cairo_move_to(cairo_.get(), part.front().x(), part.front().y());
    for (const Vector2d& p : part.subspan(1)) cairo_line_to(cairo_.get(), p.x(), p.y());
    pending += part.size();
    if (pending < kBatch) continue;
    cairo_stroke(cairo_.get());
    pending = 0;
  }
  if (pending > 0) cairo_stroke(cairo_.get());
}

void Painter::line(const Vector2d& a, const Vector2d& b, const Stroke& style) {
  set_stroke(style);
  cairo_move_to(cairo_.get(), a.x(), a.y());
  cairo_line_to(cairo_.get(), b.x(), b.y());
  cairo_stroke(cairo_.get());
}

void Painter::polygon(std::span<const Vector2d> corners, const std::optional<Colour>& fill,
                      const std::optional<Stroke>& outline) {
  if (corners.size() < 2) return;
  // cairo's coordinates overflow beyond eight million; far outside, the shape does not matter.
  constexpr double kFar = 1e5;
  for (const Vector2d& p : corners) {
    if (!p.allFinite()) return cairo_new_path(cairo_.get());
    const Vector2d near = p.cwiseMax(-kFar).cwiseMin(kFar);
    cairo_line_to(cairo_.get(), near.x(), near.y());
  }
  cairo_close_path(cairo_.get());
  if (fill) {
    set_colour(*fill);
    cairo_fill_preserve(cairo_.get());
  }
  if (outline) {
    set_stroke(*outline);
    cairo_stroke_preserve(cairo_.get());
  }
  cairo_new_path(cairo_.get());
}

void Painter::mark(const Vector2d& at, const MarkStyle& style) {
  const double r = 0.5 * style.size;
  const double width = std::clamp(0.18 * style.size, 0.5, 1.2);
  const double x = at.x();
  const double y = at.y();
  switch (style.shape) {
    case MarkShape::dot:
      cairo_arc(cairo_.get(), x, y, r, 0.0, kTwoPi);
      set_colour(style.colour);
      return cairo_fill(cairo_.get());
    case MarkShape::ring:
      cairo_arc(cairo_.get(), x, y, r - 0.5 * width, 0.0, kTwoPi);
      set_colour(kWhite);
      cairo_fill_preserve(cairo_.get());
      set_stroke({style.colour, width});
      return cairo_stroke(cairo_.get());
    case MarkShape::cross:
      line({x - r, y - r}, {x + r, y + r}, {style.colour, width});
      return line({x - r, y + r}, {x + r, y - r}, {style.colour, width});
    case MarkShape::plus:
      line({x - r, y}, {x + r, y}, {style.colour, width});
      return line({x, y - r}, {x, y + r}, {style.colour, width});
    case MarkShape::square:
      cairo_rectangle(cairo_.get(), x - r, y - r, style.size, style.size);
      set_colour(style.colour);
      return cairo_fill(cairo_.get());
    case MarkShape::diamond:
      return polygon(std::array{Vector2d(x - r, y), Vector2d(x, y - r), Vector2d(x + r, y),
                                Vector2d(x, y + r)},
                     style.colour, std::nullopt);
  }
}

void Painter::head(const Vector2d& tip, const Vector2d& along, const ArrowStyle& style) {
  const Vector2d back = tip - 0.42 * style.length * along;
  const Vector2d across = 0.19 * style.length * perpendicular(along);
  const bool filled = style.head == ArrowHead::filled;
  polygon(std::array{tip, Vector2d(back + across), Vector2d(back - across)},
          filled ? style.colour : kWhite, Stroke{style.colour, filled ? 0.1 : 0.8 * style.width});
}

void Painter::arrow(const Vector2d& tail, double angle, const ArrowStyle& style) {
  const Vector2d along(std::cos(angle), -std::sin(angle));
  const Vector2d tip = tail + style.length * along;
  const bool has_head = style.head != ArrowHead::none;
  const Vector2d shaft_end = has_head ? Vector2d(tip - 0.4 * style.length * along) : tip;
  line(tail, shaft_end, {style.colour, style.width});
  if (has_head) head(tip, along, style);
}

Vector2d Painter::text_size(const std::string& words, const TextStyle& style) {
  set_font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), printable(words).c_str(), &extents);
  return {extents.x_advance, kCapHeight * style.size};
}

void Painter::text(const Vector2d& at, const std::string& words, const TextStyle& style,
                   const TextAnchor& anchor) {
  const Vector2d size = text_size(words, style);
  const double left = at.x() + 0.5 * (anchor.horizontal - 1) * size.x();
  const double baseline = at.y() + 0.5 * (anchor.vertical + 1) * size.y();
  set_colour(style.colour);
  cairo_move_to(cairo_.get(), left, baseline);
  cairo_show_text(cairo_.get(), printable(words).c_str());
  cairo_new_path(cairo_.get());
}

void Painter::text_upwards(const Vector2d& at, const std::string& words, const TextStyle& style) {
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), at.x(), at.y());
  cairo_rotate(cairo_.get(), -0.5 * kPi);
  text({0.0, 0.0}, words, style, {0, 0});
  cairo_restore(cairo_.get());
}

void Painter::push_clip(const PageRect& rect) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), rect.min.x(), rect.min.y(), rect.size.x(), rect.size.y());
  cairo_clip(cairo_.get());
}

void Painter::pop_clip() { cairo_restore(cairo_.get()); }

Result<std::string> Painter::finish() {
  cairo_status_t status = cairo_status(cairo_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS && format_ == PictureFormat::png) {
    status = cairo_surface_write_to_png_stream(surface_.get(), append, bytes_.get());
  }
  cairo_.reset();
  cairo_surface_finish(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    return fail(std::string("cannot draw the picture: ") + cairo_status_to_string(status));
  }
  if (format_ == PictureFormat::svg) drop_surface_numbers(*bytes_);
  return std::move(*bytes_);
}

}  // namespace adit
