#include "adit/io/plan_levels.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/test_files.hpp"

namespace adit {
namespace {

TEST(PlanLevels, AFileIsOneLevelWithoutAName) {
  const test::ScratchFolder folder;
  const auto levels = read_plan_levels(folder.write("upper.csv", "0,0,1,0\n"));
  ASSERT_TRUE(levels) << to_string(levels.error());
  ASSERT_EQ(levels->size(), 1u);
  EXPECT_EQ(levels->front().name, "");
  EXPECT_EQ(levels->front().plan.segments.size(), 1u);
}

TEST(PlanLevels, EachPlanOfAFolderIsALevelInTheOrderOfTheNames) {
  const test::ScratchFolder folder;
  folder.write("upper.csv", "0,0,1,0\n");
  folder.write("Deep.CSV", "0,0,1,0\n1,0,1,1\n");
  folder.write("middle.vectormap.txt", "0,0,1,0\n1,0,1,1\n1,1,0,0\n");
  folder.write("poses.tum", "no plan\n");
  folder.write(".hidden.csv", "no plan\n");
  std::filesystem::create_directory(folder.path("folder.csv"));
  const auto levels = read_plan_levels(folder.path(""));
  ASSERT_TRUE(levels) << to_string(levels.error());
  ASSERT_EQ(levels->size(), 3u);
  EXPECT_EQ((*levels)[0].name, "Deep");
  EXPECT_EQ((*levels)[1].name, "middle");
  EXPECT_EQ((*levels)[2].name, "upper");
  EXPECT_EQ((*levels)[0].plan.segments.size(), 2u);
  EXPECT_EQ((*levels)[1].plan.segments.size(), 3u);
}

TEST(PlanLevels, ErrorsNameTheFile) {
  const test::ScratchFolder folder;
  const auto none = read_plan_levels(folder.path(""));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no plan"), std::string::npos);
  folder.write("good.csv", "0,0,1,0\n");
  const std::string bad = folder.write("worse.csv", "0,0,1,0\n0,0,x,0\n");
  const auto wrong = read_plan_levels(folder.path(""));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(std::filesystem::path(wrong.error().file), std::filesystem::path(bad));
  EXPECT_EQ(wrong.error().line, 2);
  EXPECT_FALSE(read_plan_levels(folder.path("absent")));
}

TEST(PlanLevels, TwoFilesMayNotBeOneLevel) {
  const test::ScratchFolder folder;
  folder.write("upper.csv", "0,0,1,0\n");
  folder.write("upper.txt", "0,0,1,0\n");
  const auto levels = read_plan_levels(folder.path(""));
  ASSERT_FALSE(levels);
  EXPECT_NE(levels.error().message.find("upper"), std::string::npos);
}

}  // namespace
}  // namespace adit
