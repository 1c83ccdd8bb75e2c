#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit::test {

/// A mine drawn in characters, north up: `#` is rock, `%` stands about and is in no plan, all else
/// is open, and letters are places. Beyond the drawing is rock. The lower left corner of the
/// drawing is the origin of the map.
///
///     const AsciiMap mine(R"(
///     ######
///     #A...#
///     ####.#)", 2.0);
class AsciiMap {
 public:
  /// `cell_m` is the side of the square that a character stands for (m).
  explicit AsciiMap(std::string_view art, double cell_m = 1.0) : cell_m_(cell_m) {
    while (!art.empty()) {
      const std::size_t end = art.find('\n');
      std::string row(art.substr(0, end));
      row.erase(0, row.find_first_not_of(' '));  // the indentation of the source
      if (!row.empty()) rows_.push_back(std::move(row));
      if (end == std::string_view::npos) break;
      art.remove_prefix(end + 1);
    }
  }

  /// Between rock and open space: what the plan shows.
  std::vector<Segment> plan() const {
    return edges([](char c) { return c == '#'; });
  }
  /// Around what stands about.
  std::vector<Segment> obstacles() const {
    return edges([](char c) { return c == '%'; });
  }
  /// What a scanner meets.
  std::vector<Segment> solid() const {
    std::vector<Segment> all = plan();
    const std::vector<Segment> more = obstacles();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// The middle of the first cell with this letter; not-a-number where there is none.
  Vector2d at(char place) const {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::size_t column = rows_[row].find(place);
      if (column != std::string::npos) {
        return corner(row, column) + Vector2d(0.5 * cell_m_, -0.5 * cell_m_);
      }
    }
    return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  char cell(std::size_t row, std::size_t column) const {
    return row < rows_.size() && column < rows_[row].size() ? rows_[row][column] : '#';
  }
  /// Upper left corner of a cell (m).
  Vector2d corner(std::size_t row, std::size_t column) const {
    return {cell_m_ * static_cast<double>(column),
            cell_m_ * (static_cast<double>(rows_.size()) - static_cast<double>(row))};
  }

  /// The edges with `is_inside` on one side only; cell -1 wraps to a number beyond the drawing.
  template <class IsInside>
  std::vector<Segment> edges(IsInside is_inside) const {
    std::vector<Segment> found;
    std::size_t columns = 0;
    for (const std::string& row : rows_) columns = std::max(columns, row.size());
    for (std::size_t row = 0; row <= rows_.size(); ++row) {
      for (std::size_t column = 0; column <= columns; ++column) {
        const bool here = is_inside(cell(row, column));
        if (here != is_inside(cell(row - 1, column))) {
          found.push_back({corner(row, column), corner(row, column + 1)});
        }
        if (here != is_inside(cell(row, column - 1))) {
          found.push_back({corner(row, column), corner(row + 1, column)});
        }
      }
    }
    return found;
  }

  std::vector<std::string> rows_;
  double cell_m_;
};

}  // namespace adit::test
