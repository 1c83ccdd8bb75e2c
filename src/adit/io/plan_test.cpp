#include "adit/io/plan.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "support/test_files.hpp"

namespace adit {
namespace {

std::string error_of(std::string_view text) {
  const auto plan = parse_plan(text, "plan.csv");
  return plan ? "no error" : to_string(plan.error());
}

TEST(Plan, ReadsRowsWithCommentsHeaderMarkAndBothLineEnds) {
  const auto plan = parse_plan(
      "\xef\xbb\xbf# a mine\r\nx1,y1,x2,y2\r\n1,2,3,4\r\n\r\n -1.5 , 2e1 ,+3, .25 # a "
      "wall\n0,0,1,1");
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->segments.size(), 3u);
  EXPECT_EQ(plan->segments[0].a, Vector2d(1, 2));
  EXPECT_EQ(plan->segments[0].b, Vector2d(3, 4));
  EXPECT_EQ(plan->segments[1].a, Vector2d(-1.5, 20));
  EXPECT_EQ(plan->segments[1].b, Vector2d(3, 0.25));
  EXPECT_TRUE(plan->warnings.empty());
}

TEST(Plan, TakesBlanksTabsSemicolonsAndACommaAtTheEnd) {
  for (const char* row :
       {"1 2 3 4", "1\t2\t3\t4", "1;2;3;4", "1, 2,\t3 ;4", "1,2,3,4,", "  1   2 3 4  "}) {
    const auto plan = parse_plan(row);
    ASSERT_TRUE(plan) << row << ": " << to_string(plan.error());
    EXPECT_EQ(plan->segments[0].b, Vector2d(3, 4)) << row;
  }
}

TEST(Plan, KeepsMillimetresOfSevenDigitCoordinates) {
  const auto plan = parse_plan("4512345.678,5398765.432,4512346.679,5398765.431\n");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->segments[0].a, Vector2d(4512345.678, 5398765.432));
}

TEST(Plan, SaysFileLineAndWhatWasExpected) {
  const std::string expected = "expected x1,y1,x2,y2 (four numbers, metres), found ";
  EXPECT_EQ(error_of("1,2,3,4\n1,2,3\n"), "plan.csv:2: " + expected + "only 3 fields");
  EXPECT_EQ(error_of("# c\n\n1,2,3,4,5\n"), "plan.csv:3: " + expected + "5 fields");
  EXPECT_EQ(error_of("1,2,x,4\n"), "plan.csv:1: " + expected + "\"x\"");
  EXPECT_EQ(error_of("1,2,,4\n"), "plan.csv:1: " + expected + "\"\"");
  EXPECT_EQ(error_of("1,2,nan,4\n"), "plan.csv:1: " + expected + "a number that is not finite");
  EXPECT_EQ(error_of("1,2,1e999,4\n"), "plan.csv:1: " + expected + "a number that is not finite");
  EXPECT_EQ(error_of("1,2,3,-inf\n"), "plan.csv:1: " + expected + "a number that is not finite");
  EXPECT_EQ(error_of("1,2,3,2e9\n"), "plan.csv:1: " + expected + "a coordinate beyond 1e9 m");
  EXPECT_EQ(error_of("1.2.3,2,3,4\n"), "plan.csv:1: " + expected + "\"1.2.3\"");
  EXPECT_EQ(error_of("1,2,3,0x10\n"), "plan.csv:1: " + expected + "\"0x10\"");
  EXPECT_EQ(error_of("a,b,c,d\ne,f,g,h\n"), "plan.csv:2: " + expected + "\"e\"");
  EXPECT_EQ(error_of("1,2,3,4\na,b,c,d\n"), "plan.csv:2: " + expected + "\"a\"");
  EXPECT_EQ(error_of("<!DOCTYPE html>\n"), "plan.csv:1: " + expected + "\"<!DOCTYPE\"");
}

TEST(Plan, RefusesEmptyAndBinaryData) {
  using namespace std::string_view_literals;
  EXPECT_EQ(error_of(""), "plan.csv: the file is empty");
  EXPECT_EQ(
      error_of("# nothing\n\nx1,y1,x2,y2\n"),
      "plan.csv:3: the plan holds no wall; expected x1,y1,x2,y2 (four numbers, metres) on a line");
  EXPECT_EQ(error_of("1,2,3,4\n\0\x7f"sv),
            "plan.csv:2: expected a text file (UTF-8), found binary data");
  EXPECT_EQ(error_of("\xff\xfe"
                     "1,2,3,4\n"sv),
            "plan.csv:1: expected a text file (UTF-8), found binary data");
}

TEST(Plan, LongRubbishMakesAShortMessage) {
  EXPECT_LT(error_of(std::string(1 << 20, 'x')).size(), 200u);
  EXPECT_LT(error_of(std::string(1 << 20, '\x01')).size(), 200u);
}

TEST(Plan, CountsWallsOfZeroLength) {
  const auto plan = parse_plan("1,2,3,4\n5,6,5,6\n7,8,7,8\n");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->segments.size(), 3u);
  ASSERT_EQ(plan->warnings.size(), 1u);
  EXPECT_EQ(to_string(plan->warnings[0]), "line 2: wall of zero length (2 times)");
}

TEST(Plan, ChoosesTheFormByTheEnding) {
  const test::ScratchFolder folder;
  for (const char* name : {"a.csv", "a.CSV", "a.vectormap.txt", "a"})
    EXPECT_TRUE(read_plan(folder.write(name, "1,2,3,4\n"))) << name;
  const auto dxf = read_plan(folder.write("a.dxf", "1,2,3,4\n"));
  ASSERT_FALSE(dxf);
  EXPECT_EQ(dxf.error().message,
            "plans of the form \".dxf\" are not supported yet; expected .csv or .vectormap.txt");
  EXPECT_EQ(dxf.error().file, folder.path("a.dxf"));
}

TEST(Plan, SaysWhichFileCannotBeRead) {
  const test::ScratchFolder folder;
  const auto absent = read_plan(folder.path("none.csv"));
  ASSERT_FALSE(absent);
  EXPECT_EQ(to_string(absent.error()),
            folder.path("none.csv") + ": cannot open: No such file or directory");
  std::filesystem::create_directory(folder.path("dir.csv"));
  const auto directory = read_plan(folder.path("dir.csv"));
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().message, "expected a file, not a directory");
}

TEST(Plan, WrittenPlansReadBackBitByBit) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1e7, 1e7);
  std::vector<Segment> walls;
  for (int i = 0; i < 500; ++i)
    walls.push_back(
        {{coordinate(random), coordinate(random)}, {coordinate(random) * 1e-9, 1.0 / 3}});
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_plan(walls, folder.path("plan.csv")));
  const auto plan = read_plan(folder.path("plan.csv"));
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->segments.size(), walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    EXPECT_EQ(plan->segments[i].a, walls[i].a);
    EXPECT_EQ(plan->segments[i].b, walls[i].b);
  }
}

TEST(Plan, NeverWritesWallsThatAreNotFinite) {
  const test::ScratchFolder folder;
  const std::vector<Segment> walls = {{{0, 0}, {std::nan(""), 1}}};
  EXPECT_FALSE(write_plan(walls, folder.path("plan.csv")));
  EXPECT_EQ(folder.files(), 0);
}

TEST(Plan, WritesNoFormThatItsEndingDoesNotName) {
  const test::ScratchFolder folder;
  const std::vector<Segment> walls = {{{0, 0}, {3, 1}}};
  for (const char* name : {"a.dxf", "a.geojson", "a.png"}) {
    const auto written = write_plan(walls, folder.path(name));
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().file, folder.path(name));
  }
  EXPECT_EQ(folder.files(), 0);
  for (const char* name : {"a.csv", "a.vectormap.txt", "a"})
    EXPECT_TRUE(write_plan(walls, folder.path(name))) << name;
}

TEST(Plan, ReadsAMillionWallsQuickly) {
  std::string text;
  for (int i = 0; i < 1000000; ++i) {
    const std::string n = std::to_string(i);
    text += n + ".1234,-" + n + ".5678," + n + ".25,0." + n + "\n";
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto plan = parse_plan(text);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->segments.size(), 1000000u);
  RecordProperty("seconds", std::to_string(elapsed.count()));
  EXPECT_LT(elapsed.count(), 8.0);  // ten times the target: sanitizers and busy machines
}

TEST(PlanData, AllRealPlansAreRead) {
  for (const auto& [name, walls] : {std::pair{"intel/map.csv", 354u},
                                    {"mines/niosh.csv", 2309u},
                                    {"mines/edgar.csv", 11876u},
                                    {"plans/GDC1.vectormap.txt", 1289u}}) {
    ADIT_DATA_FILE(path, name);
    const auto plan = read_plan(path);
    ASSERT_TRUE(plan) << to_string(plan.error());
    EXPECT_EQ(plan->segments.size(), walls) << name;
  }
}

TEST(PlanData, DrawingsAreNotReadYet) {
  ADIT_DATA_FILE(path, "plans/ek.dxf");
  EXPECT_FALSE(read_plan(path));
}

}  // namespace
}  // namespace adit
