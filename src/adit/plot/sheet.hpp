#pragma once

#include <string>
#include <variant>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/plot/canvas.hpp"
#include "adit/plot/chart.hpp"
#include "adit/plot/style.hpp"

namespace adit {

/// What a page is made of.
using Panel = std::variant<Canvas, Chart>;

/// A page: rows of panels, a title above, scale bar and legend below.
class Sheet {
 public:
  explicit Sheet(PictureOptions options = {}) : options_(std::move(options)) {}

  void add(Panel panel) { rows_.push_back({std::move(panel)}); }
  void add_row(std::vector<Panel> panels) { rows_.push_back(std::move(panels)); }
  void explain(LegendEntry entry) { legend_.push_back(std::move(entry)); }

  /// Writes PNG, SVG or PDF by the file's ending, whole or not at all. An Error names the file.
  Result<void> write(const std::string& path) const;

 private:
  PictureOptions options_;
  std::vector<std::vector<Panel>> rows_;
  std::vector<LegendEntry> legend_;
};

}  // namespace adit
