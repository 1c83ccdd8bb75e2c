#include "adit/matching/matching.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "adit/matching/compatibility.hpp"
#include "support/synthetic_scene.hpp"

namespace adit {
namespace {

using testing::Scene;
using testing::SceneMaker;
using testing::SceneOptions;

MatchingOptions paper() {
  MatchingOptions options;
  options.consistency = Consistency::paper;
  return options;
}

struct Count {
  int found = 0;
  int missed = 0;
  int wrong = 0;
};

Count compare(std::span<const FeaturePair> pairs, const Scene& scene) {
  const auto holds = [](const auto& list, const FeaturePair& pair) {
    return std::find(list.begin(), list.end(), pair) != list.end();
  };
  Count count;
  for (const FeaturePair& pair : pairs) ++(holds(scene.truth, pair) ? count.found : count.wrong);
  for (const FeaturePair& pair : scene.truth) count.missed += !holds(pairs, pair);
  return count;
}

Count match_scenes(const SceneOptions& scenes, const MatchingOptions& options, int seeds) {
  Matcher matcher;
  Count total;
  for (int seed = 0; seed < seeds; ++seed) {
    const Scene scene = SceneMaker(static_cast<std::uint64_t>(seed)).make(scenes);
    const MatchResult result = matcher.match(scene.sensed, scene.model, options);
    EXPECT_TRUE(result.is_maximum);
    EXPECT_LT(result.calls, 1000);
    const Count count = compare(result.pairs, scene);
    total.found += count.found;
    total.missed += count.missed;
    total.wrong += count.wrong;
  }
  return total;
}

TEST(Matcher, FindsEveryPairOfACleanRoom) {
  SceneOptions scenes;
  scenes.range_sigma = 0.0;
  const Count count = match_scenes(scenes, {}, 300);
  EXPECT_EQ(count.missed, 0);
  EXPECT_EQ(count.wrong, 0);
  EXPECT_EQ(count.found, 300 * 24);
}

TEST(Matcher, FindsThePairsAmongNoiseAndClutter) {
  SceneOptions scenes;
  scenes.boxes = 7;
  scenes.fragments = 0.2;
  scenes.lost_arms = 0.2;
  const Count count = match_scenes(scenes, {}, 300);
  EXPECT_LT(count.missed, 0.01 * count.found);
  EXPECT_LT(count.wrong, 0.01 * count.found) << "clutter flush with a wall is taken for it";
}

TEST(Matcher, FindsThePairsUnderAPoorPrediction) {
  SceneOptions scenes;
  scenes.boxes = 4;
  scenes.position_error = 2.0;
  scenes.heading_error = 0.3;
  MatchingOptions options;
  options.poserr = 2.0;
  options.angerr = 0.3;
  const Count count = match_scenes(scenes, options, 200);
  EXPECT_LT(count.missed, 0.02 * count.found);
  EXPECT_LT(count.wrong, 0.02 * count.found);
}

TEST(Matcher, PaperFindsMostPairs) {
  SceneOptions scenes;
  scenes.boxes = 4;
  const Count count = match_scenes(scenes, paper(), 300);
  EXPECT_LT(count.missed, 0.15 * count.found);
  EXPECT_LT(count.wrong, 0.05 * count.found);
}

TEST(Matcher, TakesSeveralPiecesOfOneWall) {
  SceneOptions scenes;
  scenes.fragments = 1.0;
  const Scene scene = SceneMaker(5).make(scenes);
  Matcher matcher;
  const MatchResult result = matcher.match(scene.sensed, scene.model, {});
  EXPECT_EQ(compare(result.pairs, scene).missed, 0);
  EXPECT_EQ(result.pairs.size(), 36u) << "12 corners and 12 walls in two pieces each";
}

// The other way round: the map shows a wall in two pieces, the scan shows one.
TEST(Matcher, TakesOneSensedLineForCollinearModelLines) {
  SceneOptions scenes;
  scenes.fragments = 1.0;
  scenes.range_sigma = 0.0;
  const Scene scene = SceneMaker(6).make(scenes);
  Matcher matcher;
  const MatchResult result = matcher.match(scene.model, scene.sensed, {});
  EXPECT_EQ(result.pairs.size(), 36u);
}

TEST(Matcher, DoesNotStretchAShortLineOverAGap) {
  const auto across = [](double low, double high) {
    Line line;
    line.begin = {4.0, low};
    line.end = {4.0, high};
    line.distance = 4.0;
    return line;
  };
  FeatureList model;
  model.lines = {across(-3.0, -1.0), across(1.0, 3.0)};
  FeatureList sensed;
  sensed.lines = {across(-0.2, 0.2)};
  sort_counter_clockwise(model);
  sort_counter_clockwise(sensed);
  MatchingOptions options;
  options.poserr = 2.0;
  Matcher matcher;
  EXPECT_EQ(matcher.match(sensed, model, options).pairs.size(), 1u);
  sensed.lines = {across(-3.0, 3.0)};
  sort_counter_clockwise(sensed);
  EXPECT_EQ(matcher.match(sensed, model, options).pairs.size(), 2u);
}

TEST(Matcher, OneCornerOfThePlanIsOneSensedCorner) {
  FeatureList model;
  model.corners.resize(2);
  model.corners[0].position = {4.0, 0.0};
  model.corners[1].position = {4.0, 0.3};
  FeatureList sensed;
  sensed.corners.resize(1);
  sensed.corners[0].position = {4.0, 0.1};
  sensed.corners[0].covariance = 0.01 * Matrix2d::Identity();
  sort_counter_clockwise(model);
  sort_counter_clockwise(sensed);
  Matcher matcher;
  EXPECT_EQ(matcher.match(sensed, model, {}).candidates, 2);
  EXPECT_EQ(matcher.match(sensed, model, {}).pairs.size(), 1u);
  EXPECT_EQ(matcher.match(model, sensed, {}).pairs.size(), 1u);
  EXPECT_EQ(matcher.match(sensed, model, paper()).pairs.size(), 2u) << "within terndisterr";
}

// Two candidates of equal count: the one that lies better against the others wins.
TEST(Matcher, PrefersTheBetterOfTwoSetsOfOneSize) {
  SceneOptions scenes;
  scenes.range_sigma = 0.0;
  Scene scene = SceneMaker(7).make(scenes);
  Corner twin = scene.model.corners[4];
  twin.position += Vector2d(0.05, 0.05);
  scene.model.corners.insert(scene.model.corners.begin(), twin);
  sort_counter_clockwise(scene.model);
  for (FeaturePair& pair : scene.truth) pair.model += pair.kind == FeatureKind::corner;
  Matcher matcher;
  const Count count = compare(matcher.match(scene.sensed, scene.model, {}).pairs, scene);
  EXPECT_EQ(count.missed, 0);
  EXPECT_EQ(count.wrong, 0);
}

TEST(Matcher, KeepsThePairsInCounterClockwiseOrder) {
  SceneOptions scenes;
  scenes.boxes = 5;
  const Scene scene = SceneMaker(8).make(scenes);
  Matcher matcher;
  for (const MatchingOptions& options : {MatchingOptions{}, paper()}) {
    const MatchResult result = matcher.match(scene.sensed, scene.model, options);
    std::size_t next = 0;
    for (const FeatureRef& ref : scene.sensed.order) {
      while (next < result.pairs.size() && result.pairs[next].kind == ref.kind &&
             result.pairs[next].sensed == ref.index) {
        ++next;
      }
    }
    EXPECT_EQ(next, result.pairs.size());
  }
}

TEST(Matcher, GivesTheSameFromFreshAndUsedBuffers) {
  SceneOptions scenes;
  scenes.boxes = 7;
  Matcher used;
  for (const MatchingOptions& options : {MatchingOptions{}, paper()}) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      scenes.walls = 6 + static_cast<int>(seed % 20);
      const Scene scene = SceneMaker(seed).make(scenes);
      Matcher fresh;
      const MatchResult a = used.match(scene.sensed, scene.model, options);
      const MatchResult b = fresh.match(scene.sensed, scene.model, options);
      EXPECT_TRUE(std::equal(a.pairs.begin(), a.pairs.end(), b.pairs.begin(), b.pairs.end()));
      EXPECT_EQ(a.calls, b.calls);
    }
  }
}

TEST(Matcher, OfEmptyListsFindsNothing) {
  const Scene scene = SceneMaker(9).make({});
  const FeatureList empty;
  Matcher matcher;
  for (const MatchingOptions& options : {MatchingOptions{}, paper()}) {
    EXPECT_TRUE(matcher.match(empty, empty, options).pairs.empty());
    EXPECT_TRUE(matcher.match(scene.sensed, empty, options).pairs.empty());
    const MatchResult result = matcher.match(empty, scene.model, options);
    EXPECT_TRUE(result.pairs.empty());
    EXPECT_TRUE(result.is_maximum);
    EXPECT_EQ(result.candidates, 0);
  }
}

TEST(Matcher, SaysWhenItWasCutShort) {
  SceneOptions scenes;
  scenes.boxes = 7;
  const Scene scene = SceneMaker(10).make(scenes);
  Matcher matcher;
  MatchingOptions options;
  options.max_candidates = 12;
  const MatchResult few = matcher.match(scene.sensed, scene.model, options);
  EXPECT_EQ(few.candidates, 12);
  EXPECT_FALSE(few.is_maximum);
  EXPECT_GT(few.pairs.size(), 6u);
  options = paper();
  options.max_calls = 1;
  const MatchResult cut = matcher.match(scene.sensed, scene.model, options);
  EXPECT_EQ(cut.calls, 1);
  EXPECT_FALSE(cut.is_maximum);
}

TEST(Matcher, SurvivesFeaturesThatAreNotFinite) {
  Scene scene = SceneMaker(11).make({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  scene.sensed.lines[2].distance = nan;
  scene.sensed.corners[3].covariance(0, 0) = std::numeric_limits<double>::infinity();
  scene.sensed.corners[4].bisector = nan;
  scene.model.corners[6].position.x() = nan;
  Matcher matcher;
  for (const MatchingOptions& options : {MatchingOptions{}, paper()}) {
    const MatchResult result = matcher.match(scene.sensed, scene.model, options);
    EXPECT_EQ(compare(result.pairs, scene).wrong, 0);
    EXPECT_GT(result.pairs.size(), 10u);
  }
}

// The features' frames are turned together so that the seam falls elsewhere.
RC_GTEST_PROP(MatcherLaws, TheSeamDoesNotMatter, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  SceneOptions scenes;
  scenes.boxes = *rc::gen::inRange(0, 6);
  const Scene scene = SceneMaker(seed).make(scenes);
  const Pose2 turn{0.0, 0.0, 0.001 * *rc::gen::inRange(-3141, 3141)};
  FeatureList sensed;
  FeatureList model;
  transform(scene.sensed, turn, sensed);
  transform(scene.model, turn, model);
  const MatchingOptions options = *rc::gen::element(MatchingOptions{}, paper());
  Matcher plain;
  Matcher turned;
  const MatchResult a = plain.match(scene.sensed, scene.model, options);
  const MatchResult b = turned.match(sensed, model, options);
  RC_ASSERT(a.candidates == b.candidates);
  RC_ASSERT(a.pairs.size() == b.pairs.size());
}

// What the matcher returns is consistent by the tested comparisons, and nothing can be added.
RC_GTEST_PROP(MatcherLaws, TheCliqueIsConsistentAndMaximal, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  SceneOptions scenes;
  scenes.walls = *rc::gen::inRange(4, 16);
  scenes.boxes = *rc::gen::inRange(0, 8);
  const Scene scene = SceneMaker(seed).make(scenes);
  const MatchingOptions options;
  FeatureViews sensed;
  FeatureViews model;
  CandidateList candidates;
  BitMatrix compatible;
  std::vector<std::int64_t> weights;
  make_views(scene.sensed, options, sensed);
  make_views(scene.model, options, model);
  find_candidates(sensed, model, options, candidates);
  find_compatible(sensed, model, candidates, options, compatible, weights);
  Matcher matcher;
  const MatchResult result = matcher.match(scene.sensed, scene.model, options);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < candidates.pairs.size(); ++i) {
    const Candidate& pair = candidates.pairs[i];
    const bool corner = pair.kind == FeatureKind::corner;
    const FeaturePair named{
        pair.kind, corner ? sensed.corners[pair.sensed].index : sensed.lines[pair.sensed].index,
        corner ? model.corners[pair.model].index : model.lines[pair.model].index};
    if (std::find(result.pairs.begin(), result.pairs.end(), named) != result.pairs.end()) {
      chosen.push_back(i);
    }
  }
  RC_ASSERT(chosen.size() == result.pairs.size());
  for (std::size_t i = 0; i < candidates.pairs.size(); ++i) {
    const bool inside = std::find(chosen.begin(), chosen.end(), i) != chosen.end();
    const auto friends = std::count_if(chosen.begin(), chosen.end(),
                                       [&](std::size_t j) { return compatible.test(i, j); });
    if (inside) {
      RC_ASSERT(static_cast<std::size_t>(friends) == chosen.size() - 1);
    } else {
      RC_ASSERT(static_cast<std::size_t>(friends) < chosen.size());
    }
  }
}

}  // namespace
}  // namespace adit
