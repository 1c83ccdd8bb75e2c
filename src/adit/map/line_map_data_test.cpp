#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "adit/map/line_map.hpp"
#include "support/plan_checks.hpp"

namespace adit {
namespace {

std::vector<Segment> read_plan(const std::string& file) {
  const char* data = std::getenv("ADIT_DATA");
  std::ifstream in(std::string(data != nullptr ? data : "") + "/" + file);
  std::vector<Segment> raw;
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Segment s;
    if (fields >> s.a.x() >> s.a.y() >> s.b.x() >> s.b.y()) raw.push_back(s);
  }
  return raw;
}

class RealPlan : public testing::TestWithParam<const char*> {};

TEST_P(RealPlan, is_sound_after_cleaning_and_where_it_was) {
  const auto raw = read_plan(GetParam());
  if (raw.empty()) GTEST_SKIP() << "no " << GetParam() << " in $ADIT_DATA";
  const LineMapOptions options;
  MapReport report;
  const LineMap map = LineMap::build(raw, options, &report);
  EXPECT_EQ(test::faults_of(map), "");
  EXPECT_EQ(report.not_finite, 0);
  EXPECT_GT(map.walls().size(), raw.size() / 4);

  const double bound = 2.0 * options.snap_m + options.merge_offset_m;
  const auto cleaned = test::segments_of(map);
  EXPECT_LE(test::farthest_sample(raw, cleaned, 1 + raw.size() / 200), bound);
  EXPECT_LE(test::farthest_sample(cleaned, raw, 1 + cleaned.size() / 200), bound);
}

INSTANTIATE_TEST_SUITE_P(Plans, RealPlan,
                         testing::Values("mines/edgar.csv", "mines/niosh.csv", "intel/map.csv",
                                         "plans/GDC1.vectormap.txt"),
                         [](const auto& plan) {
                           std::string name = plan.param;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return c == '/' || c == '.'; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace adit
