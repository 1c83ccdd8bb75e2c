#include "adit/plot/survey_figures.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace adit {
namespace {

class SurveyFigures : public testing::Test {
 protected:
  std::string text_of(const std::string& path) const {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string path_ = (std::filesystem::temp_directory_path() / "adit_survey_figures.svg").string();
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(SurveyFigures, DrawsMoreThePartsThereAre) {
  const std::vector<DrawnWall> walls{{{{0.0, 0.0}, {5.0, 0.0}}, 0.02, 0.01},
                                     {{{5.0, 0.0}, {5.0, 4.0}}, 0.03, 0.01}};
  ASSERT_TRUE(draw_survey(path_, {walls, {}, {}, {}}).has_value());
  const std::size_t plain = text_of(path_).size();
  const std::vector<Pose2> drive{{1.0, 1.0, 0.0}, {2.0, 1.0, 0.5}, {4.0, 3.0, 1.0}};
  const std::vector<DrawnClosure> closures{{{1.0, 1.0}, {4.0, 3.0}}};
  ASSERT_TRUE(draw_survey(path_, {walls, drive, drive, closures}).has_value());
  EXPECT_GT(text_of(path_).size(), plain);
  ASSERT_TRUE(draw_survey(path_, {walls, {}, {}, {}}, {}, {.band_sigmas = 0.0}).has_value());
  EXPECT_LT(text_of(path_).size(), plain);
}

TEST_F(SurveyFigures, DrawsChangesOfAPlan) {
  const std::vector<Segment> plan{{{0.0, 0.0}, {10.0, 0.0}}};
  ASSERT_TRUE(draw_plan_changes(path_, plan, {}).has_value());
  const std::size_t plain = text_of(path_).size();
  const std::vector<DrawnChange> changes{{"wall gone", {{{2.0, 0.0}, {4.0, 0.0}}}, {}},
                                         {"new cut", {}, {{{2.0, 3.0}, {4.0, 3.0}}}}};
  ASSERT_TRUE(draw_plan_changes(path_, plan, changes).has_value());
  EXPECT_GT(text_of(path_).size(), plain);
}

TEST_F(SurveyFigures, AcceptsEmptyInputAndRefusesOtherEndings) {
  EXPECT_TRUE(draw_survey(path_, {}).has_value());
  EXPECT_FALSE(draw_survey("survey.txt", {}).has_value());
  EXPECT_FALSE(std::filesystem::exists("survey.txt"));
}

}  // namespace
}  // namespace adit
