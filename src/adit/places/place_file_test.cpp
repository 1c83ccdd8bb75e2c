#include "adit/places/place_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <vector>

namespace adit {
namespace {

std::vector<Segment> closed(const std::vector<Vector2d>& corners) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

/// A room with a pillar off its middle, turned and stretched by `part`.
LineMap room(double part) {
  const auto box = [](double x, double y, double width, double height) {
    const std::vector<Vector2d> corners{
        {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    return closed(corners);
  };
  std::vector<Segment> walls = box(0.0, 0.0, 20.0, 12.0 + part);
  const std::vector<Segment> pillar = box(6.0, 4.0, 3.0, 2.0);
  walls.insert(walls.end(), pillar.begin(), pillar.end());
  return LineMap::build(walls);
}

std::string saved(const LineMap& map, const PlaceIndexOptions& options) {
  std::ostringstream out;
  EXPECT_TRUE(write_places(PlaceIndex::build(map, options), map, options, out));
  return out.str();
}

TEST(PlaceFile, ReadsBackWhatWasWritten) {
  const LineMap map = room(0.0);
  const PlaceIndex built = PlaceIndex::build(map);
  std::istringstream in(saved(map, {}));
  const auto read = read_places(map, {}, in);
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_TRUE(read->has_value());
  const PlaceIndex& places = **read;
  ASSERT_EQ(places.size(), built.size());
  ASSERT_GT(built.size(), 0u);
  EXPECT_EQ(places.pitch_m(), built.pitch_m());
  for (std::size_t i = 0; i < built.size(); ++i) {
    ASSERT_EQ(places.position(i), built.position(i));
    ASSERT_EQ(places.codes(i).nearest, built.codes(i).nearest);
    ASSERT_EQ(places.codes(i).farthest, built.codes(i).farthest);
  }
}

TEST(PlaceFile, DoesNotTakeTheIndexOfAnotherPlan) {
  std::istringstream in(saved(room(0.0), {}));
  const auto read = read_places(room(0.1), {}, in);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_FALSE(read->has_value());
}

TEST(PlaceFile, DoesNotTakeOneMadeWithOtherOptions) {
  PlaceIndexOptions other;
  other.least_clearance_m = 0.5;
  std::istringstream in(saved(room(0.0), other));
  const auto read = read_places(room(0.0), {}, in);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_FALSE(read->has_value());
}

/// As code wrote it that makes an index with other constants, each of them in turn.
TEST(PlaceFile, DoesNotTakeOneMadeByOtherCode) {
  const LineMap map = room(0.0);
  const std::string whole = saved(map, {});
  constexpr std::size_t kKeyAt = 8;
  int constants = 0;
  PlaceCoding::visit(kPlaceCoding, [&](const char*, const auto&) { ++constants; });
  for (int changed = 0; changed < constants; ++changed) {
    PlaceCoding other;
    int number = 0;
    PlaceCoding::visit(other, [&](const char*, auto& value) {
      if (number++ == changed) ++value;
    });
    const std::uint64_t key = place_key(map, {}, other);
    std::string text = whole;
    std::memcpy(&text[kKeyAt], &key, sizeof key);
    std::istringstream in(text);
    const auto read = read_places(map, {}, in);
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_FALSE(read->has_value()) << changed;
  }
  EXPECT_GT(constants, 0);
}

TEST(PlaceFile, RefusesOneThatIsDamaged) {
  const std::string whole = saved(room(0.0), {});
  constexpr std::size_t kHeader = 24;  // what it is, of what plan, and what it holds
  for (std::size_t at = kHeader; at < whole.size(); at += whole.size() / 13) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    std::istringstream in(damaged);
    EXPECT_FALSE(read_places(room(0.0), {}, in)) << at;
  }
}

TEST(PlaceFile, RefusesWhatIsNoIndex) {
  std::istringstream in("x1,y1,x2,y2\n0.0,0.0,20.0,0.0\n");
  const auto read = read_places(room(0.0), {}, in);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "not an index of places");
}

TEST(PlaceFile, RefusesWhatIsCutShortAnywhere) {
  const LineMap map = room(0.0);
  const std::string whole = saved(map, {});
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 50) {
    std::istringstream in(whole.substr(0, length));
    EXPECT_FALSE(read_places(map, {}, in)) << length;
  }
}

}  // namespace
}  // namespace adit
