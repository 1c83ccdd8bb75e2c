#include "adit/places/place_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "adit/threads/share_out.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

constexpr std::size_t kRays = kRangeBins * kPlaceCoding.rays_per_bin;

/// Coarse in a large plan, fine in a small one (m): of so much area inside, within such a box.
double pitch_for(double area, double box_area, const PlaceIndexOptions& options) {
  const double fine = std::max(options.finest_pitch_m, std::sqrt(area / options.enough_places));
  return std::max({std::min(options.pitch_m, fine), std::sqrt(area / options.most_places),
                   std::sqrt(box_area / kPlaceCoding.most_squares)});
}

/// Looks around from places.
class Viewer {
 public:
  Viewer(const LineMap& map, const PlaceIndexOptions& options) : map_(map), options_(options) {}

  /// False where no scanner may stand.
  bool look_from(const Vector2d& place) {
    constexpr double kStep = kTwoPi / static_cast<double>(kRays);
    if (!is_clear(place)) return false;
    visibility_.sweep(map_, place, options_.max_range_m);
    visibility_.ranges(-kPi + 0.5 * kStep, kStep, ranges_);
    return share_in_sight() >= options_.least_in_sight;
  }

  std::span<const double> ranges() const { return ranges_; }

 private:
  bool is_clear(const Vector2d& place) {
    near_.clear();
    map_.near(place, options_.least_clearance_m, near_);
    return near_.empty();
  }

  double share_in_sight() const {
    const auto seen = std::count_if(ranges_.begin(), ranges_.end(),
                                    [](double range) { return std::isfinite(range); });
    return static_cast<double>(seen) / static_cast<double>(kRays);
  }

  const LineMap& map_;
  const PlaceIndexOptions& options_;
  Visibility visibility_;
  std::vector<int> near_;
  std::array<double, kRays> ranges_{};
};

/// How large the part of a plan is where a scanner may stand, by sampling (m²).
double area_inside(const LineMap& map, const PlaceIndexOptions& options) {
  constexpr int kSide = kPlaceCoding.area_samples;
  const Vector2d size = map.bounds().size();
  Viewer viewer(map, options);
  int inside = 0;
  for (int row = 0; row < kSide; ++row) {
    // Every row is offset by another part of a step, so that no pattern of the plan is met alike.
    const double offset = std::fmod(kPlaceCoding.area_shift * row, 1.0);
    for (int column = 0; column < kSide; ++column) {
      const Vector2d part(column + offset, row + 0.5);
      inside += viewer.look_from(map.bounds().min + size.cwiseProduct(part) / kSide);
    }
  }
  return size.x() * size.y() * std::max(1, inside) / (kSide * kSide);
}

}  // namespace

/// Lists the places of one row after the other.
class PlaceIndex::RowBuilder {
 public:
  RowBuilder(const LineMap& map, const PlaceIndexOptions& options, const PlaceArrays& lattice,
             int columns, std::vector<Row>& rows)
      : viewer_(map, options), lattice_(lattice), columns_(columns), rows_(rows) {}

  void operator()(std::size_t row) {
    const Vector2d origin(lattice_.origin_x, lattice_.origin_y);
    for (int column = 0; column < columns_; ++column) {
      const PlaceArrays::Cell cell{column, static_cast<std::int32_t>(row)};
      if (!viewer_.look_from(origin + lattice_.pitch_m * Vector2d(cell.column, cell.row))) continue;
      rows_[row].cells.push_back(cell);
      rows_[row].codes.push_back(code_ranges(viewer_.ranges(), kPlaceCoding.margin));
    }
  }

 private:
  Viewer viewer_;
  const PlaceArrays& lattice_;
  int columns_;
  std::vector<Row>& rows_;
};

PlaceIndex PlaceIndex::build(const LineMap& map, const PlaceIndexOptions& options, int threads) {
  PlaceArrays arrays;
  arrays.pitch_m = options.pitch_m;
  if (map.empty()) return PlaceIndex(map, std::move(arrays));
  const Vector2d size = map.bounds().size();
  arrays.pitch_m = pitch_for(area_inside(map, options), size.x() * size.y(), options);
  if (arrays.pitch_m > options.coarsest_pitch_m) return PlaceIndex(map, std::move(arrays));
  const double pitch = arrays.pitch_m;
  arrays.origin_x = map.bounds().min.x() + kPlaceCoding.first_place * pitch;
  arrays.origin_y = map.bounds().min.y() + kPlaceCoding.first_place * pitch;
  const auto columns = static_cast<int>(size.x() / pitch) + 1;
  const auto row_count = static_cast<std::size_t>(size.y() / pitch) + 1;
  std::vector<Row> rows(row_count);
  share_out(row_count, threads, [&] { return RowBuilder(map, options, arrays, columns, rows); });
  std::size_t count = 0;
  for (const Row& row : rows) count += row.cells.size();
  arrays.cells.reserve(count);
  arrays.codes.reserve(count);
  for (Row& row : rows) {
    arrays.cells.insert(arrays.cells.end(), row.cells.begin(), row.cells.end());
    arrays.codes.insert(arrays.codes.end(), row.codes.begin(), row.codes.end());
    row = Row{};
  }
  return PlaceIndex(map, std::move(arrays));
}

PlaceIndex::PlaceIndex(const LineMap& map, PlaceArrays arrays)
    : arrays_(std::move(arrays)), walls_(map), corners_(map, walls_.origin()) {
  sort_ranges();
}

void PlaceIndex::sort_ranges() {
  constexpr std::size_t kStep = kRangeBins / kRanks;
  sorted_.resize((size() + kBlock - 1) / kBlock);
  for (std::size_t place = 0; place < size(); ++place) {
    SortedRanges& block = sorted_[place / kBlock];
    RangeBands bands = arrays_.codes[place];
    std::sort(bands.farthest.begin(), bands.farthest.end(), std::greater<>());
    std::sort(bands.nearest.begin(), bands.nearest.end());
    for (std::size_t rank = 0; rank < kRanks; ++rank) {
      block.longest[rank][place % kBlock] = bands.farthest[rank * kStep];
      block.shortest[rank][place % kBlock] = bands.nearest[rank * kStep];
    }
  }
}

std::size_t PlaceIndex::memory() const {
  return arrays_.cells.capacity() * sizeof(PlaceArrays::Cell) +
         arrays_.codes.capacity() * sizeof(RangeBands) + sorted_.capacity() * sizeof(SortedRanges) +
         walls_.memory() + corners_.memory();
}

}  // namespace adit
