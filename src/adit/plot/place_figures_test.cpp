#include "adit/plot/place_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_files.hpp"

namespace adit {
namespace {

const std::vector<Segment> kRoom = {
    {{0, 0}, {12, 0}}, {{12, 0}, {12, 8}}, {{12, 8}, {0, 8}}, {{0, 8}, {0, 0}}};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

class PlaceFigures : public ::testing::Test {
 protected:
  std::string drawn(const RankedPosesView& view) const {
    const auto done = draw_ranked_poses(folder_.path("poses.svg"), view);
    EXPECT_TRUE(done) << to_string(done.error());
    return test::contents_of(folder_.path("poses.svg"));
  }
  std::string drawn(const std::vector<SurveyedPlace>& places,
                    const std::vector<AliasLink>& links) const {
    const auto done = draw_aliases(folder_.path("aliases.svg"), kRoom, places, links);
    EXPECT_TRUE(done) << to_string(done.error());
    return test::contents_of(folder_.path("aliases.svg"));
  }

  test::ScratchFolder folder_;
};

TEST_F(PlaceFigures, EachPoseIsDrawn) {
  const Matrix3d covariance = Vector3d(0.04, 0.09, 0.01).asDiagonal();
  std::vector<WeightedPose> poses{{{3, 4, 0.5}, covariance, 1.0}};
  const std::string none = drawn(RankedPosesView{kRoom, {}, nullptr});
  const std::string one = drawn(RankedPosesView{kRoom, poses, nullptr});
  poses[0].weight = 0.7;
  poses.push_back({{9, 4, -2.0}, covariance, 0.3});
  const std::string two = drawn(RankedPosesView{kRoom, poses, nullptr});
  EXPECT_GT(count_of(one, "<path"), count_of(none, "<path"));
  EXPECT_GT(count_of(two, "<path"), count_of(one, "<path"));
}

TEST_F(PlaceFigures, TheScanLiesAtTheBestPose) {
  LaserScan scan;
  scan.bearing_step = 0.1;
  scan.max_range = 50.0;
  scan.ranges = {1.0, 1.2, 50.0, 1.4};
  const std::vector<WeightedPose> poses{{{3, 4, 0.5}, Matrix3d::Identity(), 1.0}};
  const std::string without = drawn(RankedPosesView{kRoom, poses, nullptr});
  EXPECT_GT(drawn(RankedPosesView{kRoom, poses, &scan}).size(), without.size());
  // without a pose there is no place for it
  EXPECT_EQ(drawn(RankedPosesView{kRoom, {}, &scan}), drawn(RankedPosesView{kRoom, {}, nullptr}));
}

TEST_F(PlaceFigures, PosesThatAreNotFiniteAreLeftOut) {
  const std::vector<WeightedPose> poses{{{NAN, 4, 0.5}, Matrix3d::Constant(INFINITY), NAN}};
  EXPECT_FALSE(drawn(RankedPosesView{kRoom, poses, nullptr}).empty());
}

TEST_F(PlaceFigures, EachAnswerHasItsOwnMark) {
  std::vector<SurveyedPlace> places;
  std::string before = drawn(places, {});
  for (const PlaceAnswer answer : {PlaceAnswer::unique, PlaceAnswer::open, PlaceAnswer::ambiguous,
                                   PlaceAnswer::lost, PlaceAnswer::wrong}) {
    places.push_back({{1.0 + static_cast<double>(places.size()), 4.0}, answer, 2});
    const std::string now = drawn(places, {});
    EXPECT_GT(now.size(), before.size()) << to_string(answer);
    before = now;
  }
  EXPECT_GT(drawn(places, {{{1, 4}, {9, 4}, 0.2}}).size(), before.size());
}

TEST_F(PlaceFigures, AnotherEndingIsAnError) {
  EXPECT_FALSE(draw_aliases(folder_.path("aliases.jpeg"), kRoom, {}, {}));
  EXPECT_FALSE(draw_ranked_poses(folder_.path("poses.jpeg"), {kRoom, {}, nullptr}));
  EXPECT_EQ(folder_.files(), 0);
}

}  // namespace
}  // namespace adit
