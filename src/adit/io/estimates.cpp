#include "adit/io/estimates.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "adit/io/atomic_file.hpp"
#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr const char* kHeader =
    "t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,status,protection_m,"
    "chi_square,degrees_of_freedom,pairs,dead_reckoned,open_x,open_y\n";

/// Reads one column into a row; false when the field does not fit.
struct Column {
  const char* name;
  bool required;
  bool (*read)(std::string_view field, EstimateRow& row);
};

std::optional<double> finite(std::string_view field) {
  const auto value = to_number(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

template <double Pose2::*Member>
bool read_pose(std::string_view field, EstimateRow& row) {
  const auto value = finite(field);
  if (value) row.pose.*Member = *value;
  return value.has_value();
}

template <int Row, int Col>
bool read_covariance(std::string_view field, EstimateRow& row) {
  const auto value = to_number(field);
  if (!value || std::isnan(*value)) return false;
  if (Row == Col && *value < 0.0) return false;
  row.covariance(Row, Col) = *value;
  row.covariance(Col, Row) = *value;
  return true;
}

bool read_status(std::string_view field, EstimateRow& row) {
  for (const Status status : {Status::ok, Status::degraded, Status::ambiguous, Status::lost}) {
    if (field != to_string(status)) continue;
    row.status = status;
    return true;
  }
  return false;
}

bool read_protection(std::string_view field, EstimateRow& row) {
  const auto value = to_number(field);
  if (!value || !(*value >= 0.0)) return false;
  row.protection_m = *value;
  return true;
}

bool read_stamp(std::string_view field, EstimateRow& row) {
  const auto value = finite(field);
  if (value) row.stamp = *value;
  return value.has_value();
}

bool read_chi_square(std::string_view field, EstimateRow& row) {
  const auto value = to_number(field);
  if (value) row.chi_square = *value;
  return value.has_value();
}

template <int EstimateRow::*Member>
bool read_count(std::string_view field, EstimateRow& row) {
  const auto value = finite(field);
  if (!value || *value < 0.0 || *value > 1e9 || *value != std::floor(*value)) return false;
  row.*Member = static_cast<int>(*value);
  return true;
}

bool read_dead_reckoned(std::string_view field, EstimateRow& row) {
  if (field != "0" && field != "1") return false;
  row.dead_reckoned = field == "1";
  return true;
}

template <int Axis>
bool read_open_direction(std::string_view field, EstimateRow& row) {
  const auto value = finite(field);
  if (value) row.open_direction[Axis] = *value;
  return value.has_value();
}

constexpr std::array<Column, 18> kColumns = {{
    {"t", true, read_stamp},
    {"x", true, read_pose<&Pose2::x>},
    {"y", true, read_pose<&Pose2::y>},
    {"theta", true, read_pose<&Pose2::theta>},
    {"cov_xx", true, read_covariance<0, 0>},
    {"cov_xy", true, read_covariance<0, 1>},
    {"cov_xt", true, read_covariance<0, 2>},
    {"cov_yy", true, read_covariance<1, 1>},
    {"cov_yt", true, read_covariance<1, 2>},
    {"cov_tt", true, read_covariance<2, 2>},
    {"status", true, read_status},
    {"protection_m", true, read_protection},
    {"chi_square", false, read_chi_square},
    {"degrees_of_freedom", false, read_count<&EstimateRow::degrees_of_freedom>},
    {"pairs", false, read_count<&EstimateRow::pairs>},
    {"dead_reckoned", false, read_dead_reckoned},
    {"open_x", false, read_open_direction<0>},
    {"open_y", false, read_open_direction<1>},
}};

/// Which column each field of a row is; null for one that is not known.
Result<std::vector<const Column*>> parse_header(std::string_view line, const std::string& file,
                                                long number) {
  std::vector<const Column*> order;
  std::array<bool, kColumns.size()> met{};
  Fields fields(line);
  for (std::string_view field; fields.next(field);) {
    order.push_back(nullptr);
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (field != kColumns[i].name) continue;
      if (met[i]) return fail("column " + in_quotes(field) + " stands twice", file, number);
      met[i] = true;
      order.back() = &kColumns[i];
    }
  }
  for (std::size_t i = 0; i < kColumns.size(); ++i)
    if (kColumns[i].required && !met[i])
      return fail(std::string("expected a header with the column ") + kColumns[i].name, file,
                  number);
  return order;
}

std::optional<std::string> parse_row(std::string_view line, const std::vector<const Column*>& order,
                                     EstimateRow& row) {
  Fields fields(line);
  std::string_view field;
  for (const Column* column : order) {
    if (!fields.next(field)) return std::to_string(order.size()) + " fields, found fewer";
    if (column != nullptr && !column->read(field, row))
      return std::string(column->name) + ", found " + in_quotes(field);
  }
  if (fields.next(field)) return std::to_string(order.size()) + " fields, found more";
  return std::nullopt;
}

/// An unknown variance makes its row and column unknown too: `inf` and zeros.
Matrix3d known_or_infinite(const Matrix3d& covariance) {
  Matrix3d out = covariance;
  for (int i = 0; i < 3; ++i) {
    if (covariance(i, i) >= 0.0 && std::isfinite(covariance(i, i))) continue;
    out.row(i).setZero();
    out.col(i).setZero();
    out(i, i) = std::numeric_limits<double>::infinity();
  }
  return out;
}

}  // namespace

EstimateRow to_row(const Estimate& e) {
  return {e.stamp,
          e.pose,
          e.covariance,
          e.status,
          e.protection_m,
          e.chi_square,
          e.degrees_of_freedom,
          static_cast<int>(e.pairs.size()),
          e.dead_reckoned,
          e.open_direction.value_or(Vector2d::Zero())};
}

std::string format_estimates(std::span<const EstimateRow> rows) {
  std::string text = kHeader;
  for (const EstimateRow& row : rows) {
    const Matrix3d c = known_or_infinite(row.covariance);
    const double protection =
        std::isnan(row.protection_m) ? std::numeric_limits<double>::infinity() : row.protection_m;
    fmt::format_to(std::back_inserter(text),
                   FMT_COMPILE("{:.6f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n"),
                   row.stamp, row.pose.x, row.pose.y, row.pose.theta, c(0, 0), c(0, 1), c(0, 2),
                   c(1, 1), c(1, 2), c(2, 2), to_string(row.status), protection, row.chi_square,
                   row.degrees_of_freedom, row.pairs, row.dead_reckoned ? 1 : 0,
                   row.open_direction.x(), row.open_direction.y());
  }
  return text;
}

Result<void> write_estimates(std::span<const EstimateRow> rows, const std::string& path) {
  return write_file(path, format_estimates(rows));
}

Result<std::vector<EstimateRow>> parse_estimates(std::string_view text, const std::string& file) {
  if (const auto checked = check_text(text, file); !checked) return tl::unexpected(checked.error());
  std::vector<EstimateRow> rows;
  std::optional<std::vector<const Column*>> order;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view content = strip_comment(line);
    if (content.empty()) continue;
    if (!order) {
      auto header = parse_header(content, file, lines.number());
      if (!header) return tl::unexpected(header.error());
      order = std::move(*header);
      continue;
    }
    EstimateRow row;
    if (const auto wrong = parse_row(content, *order, row))
      return fail("expected " + *wrong, file, lines.number());
    rows.push_back(row);
  }
  if (!order) return fail(std::string("expected a header: ") + kHeader, file, lines.number());
  return rows;
}

Result<std::vector<EstimateRow>> read_estimates(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_estimates(*text, path);
}

}  // namespace adit
