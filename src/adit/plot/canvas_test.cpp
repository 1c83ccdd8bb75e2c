#include "adit/plot/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adit/plot/labels.hpp"
#include "adit/plot/ticks.hpp"
#include "adit/plot/utf8.hpp"

namespace adit {
namespace {

TEST(Canvas, ViewHoldsEverythingAddedAndIsNeverASliver) {
  Canvas canvas;
  const std::vector<Vector2d> flat{{0.0, 5.0}, {40.0, 5.0}};
  canvas.polyline(flat, {});
  const Box view = canvas.view();
  EXPECT_LT(view.min.x(), 0.0);
  EXPECT_GT(view.max.x(), 40.0);
  EXPECT_GE(view.size().y(), 9.9);
  EXPECT_NEAR(view.center().y(), 5.0, 1e-9);
}

TEST(Canvas, EmptyAndSinglePointViewsHaveASize) {
  Canvas canvas;
  EXPECT_GT(canvas.view().size().minCoeff(), 0.5);
  canvas.mark({7.0, 7.0}, {});
  EXPECT_GT(canvas.view().size().minCoeff(), 0.5);
  EXPECT_NEAR(canvas.view().center().x(), 7.0, 1e-9);
}

TEST(Canvas, AreasAndBadNumbersDoNotWidenTheView) {
  Canvas canvas;
  canvas.mark({0.0, 0.0}, {});
  canvas.mark({1.0, 1.0}, {});
  const Box before = canvas.view();
  canvas.ellipse({0.0, 0.0}, Matrix2d::Identity() * 1e6, 3.0, kBlue, std::nullopt);
  canvas.sector({0.0, 0.0}, 500.0, 0.0, 1.0, kBlue);
  canvas.mark({std::numeric_limits<double>::quiet_NaN(), 1e9}, {});
  EXPECT_EQ(canvas.view().min, before.min);
  EXPECT_EQ(canvas.view().max, before.max);
}

TEST(PagePath, LinesAreCutAtTheWindow) {
  PathPoints world;
  world.begin();
  world.points = {{-1e9, 0.5}, {1e9, 0.5}};
  const PageRect window{{0.0, -10.0}, {20.0, 20.0}};
  const PathPoints page = to_page(world, WorldToPage{}, window);
  ASSERT_EQ(page.count(), 1U);
  EXPECT_NEAR(page.points.front().x(), 0.0, 1e-6);
  EXPECT_NEAR(page.points.back().x(), 20.0, 1e-6);
  EXPECT_NEAR(page.points.back().y(), -0.5, 1e-6);  // the page's y points down
}

TEST(PagePath, WhatTheEyeCannotTellApartIsDrawnOnce) {
  PathPoints world;
  for (int i = 0; i < 1000; ++i) {
    world.begin();
    world.points.emplace_back(0.0, 0.0);
    world.points.emplace_back(5.0, 1e-4 * (i % 3));
  }
  const PathPoints page = to_page(world, WorldToPage{}, PageRect{{-10, -10}, {20, 20}});
  EXPECT_EQ(page.count(), 1U);
}

TEST(PagePath, NotANumberLiftsThePen) {
  PathPoints world;
  world.begin();
  world.points = {{0, 0}, {1, 0}, {NAN, 0}, {3, 0}, {4, 0}};
  const PathPoints page = to_page(world, WorldToPage{}, PageRect{{-10, -10}, {20, 20}});
  EXPECT_EQ(page.count(), 2U);
  EXPECT_EQ(page.points.size(), 4U);
}

TEST(Labels, KeepApartFromEachOtherAndFromLines) {
  const PageRect area{{0, 0}, {200, 200}};
  LabelPlacer placer(area);
  PathPoints line;
  line.begin();
  line.points = {{0, 100}, {200, 100}};
  placer.occupy(line, 0.7);
  const Vector2d size(12.0, 6.0);
  std::vector<PageRect> boxes;
  for (int i = 0; i < 12; ++i) {
    const LabelPlacer::Spot spot = placer.place({20.0 + 14.0 * i, 100.0}, 3.0, size);
    EXPECT_FALSE(spot.crowded);
    EXPECT_TRUE(spot.box.max().y() <= 100.0 || spot.box.min.y() >= 100.0);
    for (const PageRect& other : boxes) {
      const bool apart =
          ((spot.box.center() - other.center()).cwiseAbs() - size).maxCoeff() >= -1e-9;
      EXPECT_TRUE(apart);
    }
    boxes.push_back(spot.box);
  }
}

TEST(Ticks, AreRoundAndNotTooMany) {
  EXPECT_EQ(ticks(0.0, 10.0, 5), (std::vector<double>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  for (double range = 1e-6; range < 1e9; range *= 1.37) {
    const std::vector<double> values = ticks(-0.3 * range, 0.7 * range, 6);
    EXPECT_GE(values.size(), 2U) << range;
    EXPECT_LE(values.size(), 7U) << range;
  }
  EXPECT_TRUE(ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(ticks(0.0, std::numeric_limits<double>::infinity(), 5).empty());
  EXPECT_EQ(decade_ticks(0.5, 200.0, 9), (std::vector<double>{1.0, 10.0, 100.0}));
}

TEST(Ticks, TextHasTheDecimalsOfTheStep) {
  EXPECT_EQ(tick_text(0.5, 0.25), "0.5");
  EXPECT_EQ(tick_text(3.0, 1.0), "3");
  EXPECT_EQ(tick_text(-0.02, 0.01), "\u22120.02");
  EXPECT_EQ(tick_text(-1e-17, 0.1), "0.0");
  EXPECT_EQ(tick_text(6512345.0, 5.0), "6512345");
}

TEST(Ticks, RoundDownGivesOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_down(7.3), 5.0);
  EXPECT_DOUBLE_EQ(round_down(0.49), 0.2);
  EXPECT_DOUBLE_EQ(round_down(10.0), 10.0);
  EXPECT_DOUBLE_EQ(round_down(-1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down(NAN), 1.0);
}

TEST(Utf8, KeepsTextAndReplacesEverythingElse) {
  EXPECT_EQ(printable("Fig. 5: 3\u03c3 \u2212"), "Fig. 5: 3\u03c3 \u2212");
  EXPECT_EQ(printable("a\xff\x62"), "a?b");
  EXPECT_EQ(printable("\xc0\xaf"), "??");
  EXPECT_EQ(printable("\xe2\x82"), "??");
  EXPECT_EQ(printable("line\nend\t"), "line?end?");
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");
}

}  // namespace
}  // namespace adit
