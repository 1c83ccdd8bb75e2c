#include "adit/places/wall_field.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace adit {
namespace {

constexpr float kReach = 1.5F;  // m
constexpr float kPiece = 2.0F;  // walls are drawn in pieces no longer than this (m)

// A plan with more squares than this has walls astray; the field covers none of it.
constexpr double kMostSquares = 4.0e9;
constexpr double kLongestSide = 1e6;  // m: single precision is a hand's breadth there

float squared_distance(const WallField::Line& line, float x, float y) {
  const float dx = x - line.x;
  const float dy = y - line.y;
  const float along = dx * line.along_x + dy * line.along_y;
  const float beyond = along - std::clamp(along, 0.0F, line.length);
  const float across = dy * line.along_x - dx * line.along_y;
  return beyond * beyond + across * across;
}

/// Calls `each(column, row)` for the squares, so many a metre, around a wall and within reach of
/// it; some come more than once.
template <class Each>
void for_each_square(const WallField::Line& wall, float per_metre, const Each& each) {
  const int pieces = 1 + static_cast<int>(wall.length / kPiece);
  const float step = wall.length / static_cast<float>(pieces);
  for (int piece = 0; piece < pieces; ++piece) {
    const float from = step * static_cast<float>(piece);
    const auto span = [&](float start, float along) {
      const float a = start + from * along;
      const float b = a + step * along;
      return std::array<std::int32_t, 2>{
          static_cast<std::int32_t>((std::min(a, b) - kReach) * per_metre),
          static_cast<std::int32_t>((std::max(a, b) + kReach) * per_metre)};
    };
    const auto across = span(wall.x, wall.along_x);
    const auto up = span(wall.y, wall.along_y);
    for (std::int32_t row = up[0]; row <= up[1]; ++row) {
      for (std::int32_t column = across[0]; column <= across[1]; ++column) each(column, row);
    }
  }
}

}  // namespace

WallField::WallField(const LineMap& map) {
  if (map.empty()) return;
  const Vector2d size = map.bounds().size() + Vector2d::Constant(4.0 * kReach);
  const Vector2d squares = kPerMetre * size;
  if (!(squares.x() * squares.y() < kMostSquares && size.maxCoeff() < kLongestSide)) return;
  origin_ = map.bounds().min - Vector2d::Constant(2.0 * kReach);
  width_ = static_cast<float>(size.x());
  height_ = static_cast<float>(size.y());
  tile_columns_ = (static_cast<std::int32_t>(squares.x()) >> kTileBits) + 1;
  const std::int32_t tile_rows = (static_cast<std::int32_t>(squares.y()) >> kTileBits) + 1;
  tiles_.assign(static_cast<std::size_t>(tile_rows) * static_cast<std::size_t>(tile_columns_), 0);
  lines_.reserve(1 + map.walls().size());
  for (const Wall& wall : map.walls()) {
    const Segment& segment = wall.segment;
    const Vector2d a = segment.a - origin_;
    const double length = segment.length();
    const Vector2d along = (segment.b - segment.a) / length;
    lines_.push_back({static_cast<float>(a.x()), static_cast<float>(a.y()),
                      static_cast<float>(along.x()), static_cast<float>(along.y()),
                      static_cast<float>(length)});
  }
  lay_out_tiles();
  for (std::size_t i = 1; i < lines_.size(); ++i) {
    for_each_square(lines_[i], kPerMetre, [&](std::int32_t column, std::int32_t row) {
      offer(column, row, static_cast<std::int32_t>(i));
    });
  }
}

/// Gives each tile that a wall comes near to its squares: all at once, for in a large plan they
/// take gigabytes, and in the order of the walls, so that near ones lie near in memory.
void WallField::lay_out_tiles() {
  std::int32_t next = 1;
  for (const Line& line : std::span(lines_).subspan(1)) {
    for_each_square(line, kPerMetre, [&](std::int32_t column, std::int32_t row) {
      std::int32_t& tile = tiles_[tile_of(column, row)];
      if (tile == 0) tile = next++;
    });
  }
  cells_.resize(static_cast<std::size_t>(next));
  offs_.resize(static_cast<std::size_t>(next));
  for (TileOffs& tile : offs_) tile.fill(kFarOff);
}

void WallField::offer(std::int32_t column, std::int32_t row, std::int32_t line) {
  const float x = (static_cast<float>(column) + 0.5F) / kPerMetre;
  const float y = (static_cast<float>(row) + 0.5F) / kPerMetre;
  const float squared = squared_distance(lines_[static_cast<std::size_t>(line)], x, y);
  if (squared > kReach * kReach) return;
  const std::int32_t tile = tiles_[tile_of(column, row)];
  std::int32_t& nearest = cells_[static_cast<std::size_t>(tile)][cell_of(column, row)];
  const bool is_nearer =
      nearest == kNone ||
      squared < squared_distance(lines_[static_cast<std::size_t>(nearest)], x, y);
  if (!is_nearer) return;
  nearest = line;
  const float steps = std::min(std::sqrt(squared) / kOffStep, static_cast<float>(kFarOff));
  offs_[static_cast<std::size_t>(tile)][cell_of(column, row)] = static_cast<std::uint8_t>(steps);
}

std::optional<WallField::Meeting> WallField::meet(const Vector2d& point) const {
  const Vector2d here = point - origin_;
  const std::int32_t number = nearest(static_cast<float>(here.x()), static_cast<float>(here.y()));
  if (number == kNone) return std::nullopt;
  const Line* line = &lines_[static_cast<std::size_t>(number)];
  const Vector2d along(static_cast<double>(line->along_x), static_cast<double>(line->along_y));
  const Vector2d from = here - Vector2d(static_cast<double>(line->x), static_cast<double>(line->y));
  const double way = along.dot(from);
  constexpr double kSlack = kBeyondEnd;
  if (way < -kSlack || way > static_cast<double>(line->length) + kSlack) return std::nullopt;
  return Meeting{number - 1, cross(along, from), Vector2d(-along.y(), along.x())};
}

bool WallField::is_between(float from_x, float from_y, float to_x, float to_y,
                           float behind_m) const {
  constexpr float kStep = 1.0F / kPerMetre;
  constexpr float kFreeStep = 1.0F;       // where no wall is near
  constexpr float kFarthestHit = 500.0F;  // from the scanner (m)
  const float dx = to_x - from_x;
  const float dy = to_y - from_y;
  const float range = std::sqrt(dx * dx + dy * dy);
  if (!(range > behind_m)) return false;
  const float east = dx / range;
  const float north = dy / range;
  std::int32_t before = kNone;
  for (float way = 0.0F; way < std::min(range, kFarthestHit);) {
    const std::int32_t number = nearest(from_x + way * east, from_y + way * north);
    way += number == kNone ? kFreeStep : kStep;
    if (number == kNone || number == before) continue;
    before = number;
    const Line* line = &lines_[static_cast<std::size_t>(number)];
    // How far to the wall's left both points lie.
    const float start = (from_y - line->y) * line->along_x - (from_x - line->x) * line->along_y;
    const float end = (to_y - line->y) * line->along_x - (to_x - line->x) * line->along_y;
    if (start * end >= 0.0F || std::abs(end) < behind_m) continue;
    const float met = range * start / (start - end);
    const float along = (from_x + met * east - line->x) * line->along_x +
                        (from_y + met * north - line->y) * line->along_y;
    if (along > 0.0F && along < line->length) return true;
  }
  return false;
}

std::size_t WallField::memory() const {
  return tiles_.capacity() * sizeof(std::int32_t) + cells_.capacity() * sizeof(Tile) +
         offs_.capacity() * sizeof(TileOffs) + lines_.capacity() * sizeof(Line);
}

}  // namespace adit
