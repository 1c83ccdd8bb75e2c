#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>

#include "adit/plot/figures.hpp"
#include "adit/plot/sheet.hpp"

// fontconfig keeps a little memory for the life of the process; LeakSanitizer asks for this name.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }

namespace adit {
namespace {

namespace fs = std::filesystem;

/// A directory of its own for each test, gone afterwards.
class PlotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("adit-plot-" + std::to_string(::getpid()) + "-" + info->name());
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::size_t big_endian(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
  return value;
}
std::size_t png_width(const std::string& bytes) { return big_endian(bytes, 16); }
std::size_t png_height(const std::string& bytes) { return big_endian(bytes, 20); }

// A room with a recess, a pillar in it, and what a scanner at `observer` meets.
const Vector2d kObserver(3.0, 2.0);

std::vector<Segment> outline(const std::vector<Vector2d>& points) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    walls.push_back({points[i], points[(i + 1) % points.size()]});
  }
  return walls;
}

std::vector<Segment> room() {
  std::vector<Segment> walls = outline({{0, 0}, {12, 0}, {12, 8}, {7, 8}, {7, 7}, {0, 7}});
  const std::vector<Segment> pillar = outline({{5, 3}, {5, 5}, {7, 5}, {7, 3}});
  walls.insert(walls.end(), pillar.begin(), pillar.end());
  return walls;
}

double range_to(const std::vector<Segment>& walls, const Vector2d& from, const Vector2d& along) {
  double nearest = 100.0;
  for (const Segment& wall : walls) {
    const Vector2d side = wall.b - wall.a;
    const double sine = cross(along, side);
    if (std::abs(sine) < 1e-12) continue;
    const double range = cross(wall.a - from, side) / sine;
    const double share = cross(wall.a - from, along) / sine;
    if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

LaserScan room_scan() {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 720;
  scan.max_range = 30.0;
  for (std::size_t i = 0; i < 720; ++i) {
    const double ripple = 0.02 * std::sin(37.0 * static_cast<double>(i));
    scan.ranges.push_back(range_to(room(), kObserver, unit_vector(scan.bearing(i))) + ripple);
  }
  return scan;
}

FeatureList room_features() {
  FeatureList features;
  features.lines = {{{-3, -2}, {9, -2}, -0.5 * kPi, 2.0}, {{-3, 5}, {-3, -2}, kPi, 3.0}};
  Corner inner;
  inner.position = {-3, -2};
  inner.concave_angle = 0.5 * kPi;
  inner.bisector = 0.25 * kPi;
  inner.arms = {1, 0};
  Corner edge;
  edge.position = {2, 1};
  edge.occluding = true;
  features.corners = {inner, edge};
  sort_counter_clockwise(features);
  return features;
}

ViewFromPlace room_view() {
  ViewFromPlace view{kObserver, {}, room_features()};
  view.intervals.push_back({0, {-3, -2}, {9, -2}, Boundary::vertex, Boundary::occluded, 0, -1});
  view.intervals.push_back({5, {-3, 5}, {-3, -2}, Boundary::vertex, Boundary::vertex, 5, 0});
  return view;
}

MatchView room_match(const FeatureList& features, const std::vector<Segment>& plan,
                     const std::vector<FeaturePair>& pairs) {
  const Pose2 pose{kObserver.x(), kObserver.y(), 0.0};
  return {plan, &features, pose, &features, {pose.x + 0.05, pose.y, 0.01}, pairs};
}

CornerOperatorView room_operator() {
  std::vector<Vector2d> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(0.05 * i, 0.004 * (i % 3));
  for (int i = 0; i < 60; ++i) points.emplace_back(3.0 + 0.004 * (i % 3), 0.05 * i);
  return slide_corner_operator(points, 1.0, 0.01);
}

std::vector<Pose2> drive(int count) {
  std::vector<Pose2> poses;
  for (int i = 0; i < count; ++i) {
    const double turn = kTwoPi * 3.0 * i / count;
    poses.push_back(
        {6.0 + 4.0 * std::cos(turn), 4.0 + 2.5 * std::sin(0.7 * turn), wrap_angle(turn)});
  }
  return poses;
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::vector<TrajectoryPoint> run_along(const std::vector<Pose2>& poses) {
  constexpr std::array<Status, 4> kAll{Status::ok, Status::degraded, Status::ambiguous,
                                       Status::lost};
  std::vector<TrajectoryPoint> run;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Matrix3d covariance = Matrix3d::Identity() * 0.01;
    if (i % 7 == 3) covariance(0, 0) = std::numeric_limits<double>::infinity();
    const Status status = kAll[i * 4 / poses.size()];
    const bool is_given = status == Status::ok || status == Status::degraded;
    const double level = is_given ? 0.2 + 0.01 * static_cast<double>(i % 5) : kInfinite;
    run.push_back({poses[i], covariance, status, level, 0.01});
  }
  return run;
}

using Draw = std::function<Result<void>(const std::string& path)>;
struct NamedDraw {
  std::string name;
  Draw draw;
};

/// Every figure, with inputs or without any.
std::vector<NamedDraw> every_figure(bool filled) {
  const std::vector<Segment> plan = filled ? room() : std::vector<Segment>{};
  const LineMap map = LineMap::build(plan);
  const FeatureList features = filled ? room_features() : FeatureList{};
  const LaserScan scan = filled ? room_scan() : LaserScan{};
  const std::vector<Pose2> poses = filled ? drive(16) : std::vector<Pose2>{};
  std::vector<FeaturePair> pairs;
  std::vector<ViewFromPlace> places;
  CornerOperatorView view;
  Chart chart;
  if (filled) {
    pairs = {{FeatureKind::corner, 0, 0}, {FeatureKind::line, 0, 0}, {FeatureKind::line, 1, 0}};
    places = {room_view(), room_view()};
    view = room_operator();
    chart.series = {{"error", {{0, 1}, {1, 2}, {2, NAN}, {3, 1}, {4, 4}}, Stroke{}, MarkStyle{}}};
    chart.levels = {{"bound", 3.0}};
  }
  const Pose2 at{kObserver.x(), kObserver.y(), 0.0};
  return {
      {"map", [=](const auto& p) { return draw_map(p, plan); }},
      {"check", [=](const auto& p) { return draw_map_check(p, plan, map); }},
      {"visible", [=](const auto& p) { return draw_visible_features(p, plan, places); }},
      {"operator", [=](const auto& p) { return draw_corner_operator(p, view); }},
      {"motion", [=](const auto& p) { return draw_motion_history(p, plan, poses, poses); }},
      {"scan",
       [=](const auto& p) {
         return draw_scan(p, {&scan, &features, {}, {}});
       }},
      {"scan-map",
       [=](const auto& p) {
         return draw_scan(p, {&scan, nullptr, at, plan});
       }},
      {"predicted",
       [=](const auto& p) {
         return draw_predicted_features(p, room_match(features, plan, pairs));
       }},
      {"extracted",
       [=](const auto& p) {
         return draw_extracted_features(p, room_match(features, plan, pairs));
       }},
      {"match", [=](const auto& p) { return draw_match(p, room_match(features, plan, pairs)); }},
      {"paths", [=](const auto& p) { return draw_paths(p, plan, poses, poses); }},
      {"trajectory",
       [=](const auto& p) { return draw_trajectory(p, plan, run_along(poses), poses); }},
      {"chart", [=](const auto& p) { return draw_chart(p, chart); }},
  };
}

TEST_F(PlotTest, EveryFigureIsWrittenInEveryFormat) {
  for (const NamedDraw& figure : every_figure(true)) {
    SCOPED_TRACE(figure.name);
    for (const std::string ending : {".png", ".svg", ".pdf"}) {
      const Result<void> done = figure.draw(file(figure.name + ending));
      ASSERT_TRUE(done) << to_string(done.error());
    }
    const std::string png = bytes_of(file(figure.name + ".png"));
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_GT(png.size(), 4000U);
    EXPECT_LT(png.size(), 300000U);
    EXPECT_GE(png_width(png), 500U);
    EXPECT_LE(png_width(png), 1040U);  // 120 mm at 220 dots an inch
    EXPECT_LE(png_height(png), 1800U);
    const std::string svg = bytes_of(file(figure.name + ".svg"));
    EXPECT_EQ(svg.substr(0, 5), "<?xml");
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    const std::string pdf = bytes_of(file(figure.name + ".pdf"));
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  }
  EXPECT_EQ(files(), every_figure(true).size() * 3);  // no part of any other file is left
}

TEST_F(PlotTest, EmptyInputsGivePicturesAsWell) {
  for (const NamedDraw& figure : every_figure(false)) {
    for (const std::string ending : {".png", ".svg", ".pdf"}) {
      const Result<void> done = figure.draw(file(figure.name + ending));
      EXPECT_TRUE(done) << figure.name << ending << ": " << to_string(done.error());
    }
  }
}

TEST_F(PlotTest, EqualPicturesAreEqualFiles) {
  for (const NamedDraw& figure : every_figure(true)) {
    for (const std::string ending : {".png", ".svg", ".pdf"}) {
      ASSERT_TRUE(figure.draw(file("first" + ending)));
      ASSERT_TRUE(figure.draw(file("second" + ending)));
      EXPECT_EQ(bytes_of(file("first" + ending)), bytes_of(file("second" + ending)))
          << figure.name << ending;
    }
  }
}

TEST_F(PlotTest, NumbersThatAreNotFiniteAreLeftOut) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Segment> plan = room();
  plan.push_back({{NAN, 0.0}, {1.0, 1.0}});
  plan.push_back({{0.0, inf}, {1.0, 1.0}});
  std::vector<Pose2> poses = drive(10);
  poses[4].x = NAN;
  poses[6].theta = inf;
  LaserScan scan = room_scan();
  scan.ranges[5] = NAN;
  scan.ranges[9] = inf;
  EXPECT_TRUE(draw_map(file("map.svg"), plan));
  EXPECT_TRUE(draw_motion_history(file("motion.svg"), plan, poses, poses));
  EXPECT_TRUE(draw_trajectory(file("run.svg"), plan, run_along(poses), poses));
  EXPECT_TRUE(draw_scan(file("scan.svg"), {&scan, nullptr, {NAN, 0.0, 0.0}, plan}));
  EXPECT_EQ(bytes_of(file("map.svg")).find("nan"), std::string::npos);
  ASSERT_TRUE(draw_map(file("clean.svg"), room()));
  EXPECT_EQ(bytes_of(file("map.svg")), bytes_of(file("clean.svg")));
}

TEST_F(PlotTest, AnotherEndingIsAnErrorThatNamesTheFile) {
  for (const std::string name : {"map.jpg", "map", "png", "map.png.bak", ".png"}) {
    const Result<void> done = draw_map(file(name), room());
    ASSERT_FALSE(done) << name;
    EXPECT_EQ(done.error().file, file(name));
    EXPECT_NE(done.error().message.find(".svg"), std::string::npos);
  }
  EXPECT_EQ(files(), 0U);
  EXPECT_TRUE(draw_map(file("MAP.PNG"), room()));
}

TEST_F(PlotTest, APathThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  EXPECT_FALSE(draw_map(file("missing/map.png"), room()));
  fs::create_directory(file("folder.png"));
  const Result<void> onto_folder = draw_map(file("folder.png"), room());
  ASSERT_FALSE(onto_folder);
  EXPECT_NE(to_string(onto_folder.error()).find("folder.png"), std::string::npos);
  EXPECT_EQ(files(), 1U);
}

TEST_F(PlotTest, AnOlderPictureIsReplacedAndALinkStaysALink) {
  std::ofstream(file("old.svg")) << "old";
  fs::create_symlink(file("old.svg"), file("link.svg"));
  ASSERT_TRUE(draw_map(file("link.svg"), room()));
  EXPECT_TRUE(fs::is_symlink(file("link.svg")));
  EXPECT_EQ(bytes_of(file("old.svg")).substr(0, 5), "<?xml");
}

TEST_F(PlotTest, OptionsOutOfRangeAreErrors) {
  PictureOptions options;
  options.width_mm = NAN;
  EXPECT_FALSE(draw_map(file("map.png"), room(), options));
  options = {};
  options.dots_per_inch = 1e6;
  EXPECT_FALSE(draw_map(file("map.png"), room(), options));
  EXPECT_EQ(files(), 0U);
}

TEST_F(PlotTest, APictureHasTheSizeThatWasAskedFor) {
  PictureOptions options;
  options.width_mm = 254.0;
  options.max_height_mm = 300.0;
  options.dots_per_inch = 100.0;
  ASSERT_TRUE(draw_map(file("map.png"), room(), options));
  EXPECT_EQ(png_width(bytes_of(file("map.png"))), 1000U);
}

TEST_F(PlotTest, ATitleOfAnyBytesDoesNotSpoilThePicture) {
  PictureOptions options;
  options.title = "plan \xff\xc0\x80 of \xe2\x82 \xed\xa0\x80 5 m\u00b2 \n";
  EXPECT_TRUE(draw_map(file("map.svg"), room(), options));
  options.title = std::string(5000, 'w');
  EXPECT_TRUE(draw_map(file("map.png"), room(), options));
}

TEST_F(PlotTest, ExtremeCoordinatesAreDrawn) {
  const std::vector<Segment> mine{{{6512345.123, 3123456.0}, {6512350.0, 3123456.5}}};
  PictureOptions options;
  options.axes = true;
  EXPECT_TRUE(draw_map(file("mine.png"), mine, options));
  const std::vector<Segment> far{{{-1e15, 3.0}, {1e15, 4.0}}};
  const Pose2 at{3.0, 3.0, 0.0};
  EXPECT_TRUE(draw_paths(file("far.svg"), far, {&at, 1}, {}));
  const std::vector<Segment> dot{{{1.0, 1.0}, {1.0, 1.0}}};
  EXPECT_TRUE(draw_map(file("dot.svg"), dot));
}

TEST_F(PlotTest, TheOperatorsPeakStandsAtTheCorner) {
  const CornerOperatorView view = room_operator();
  ASSERT_FALSE(view.positions.empty());
  const OperatorPosition* best = &view.positions.front();
  for (const OperatorPosition& at : view.positions) {
    if (at.gain > best->gain) best = &at;
  }
  EXPECT_LT((best->vertex - Vector2d(3.0, 0.0)).norm(), 0.15);
  EXPECT_GT(best->gain, view.threshold);
  EXPECT_NEAR((best->left_end - best->vertex).norm(), 1.0, 0.1);
}

TEST_F(PlotTest, LargePlansAndLongRunsDrawQuicklyAndStaySmall) {
  std::vector<Segment> plan;
  for (int i = 0; i < 60000; ++i) {
    const double x = 2.0 * (i % 300);
    const double y = 2.0 * (i / 300);
    plan.push_back({{x, y}, {x + 1.0, y + 0.3 * (i % 5)}});
  }
  std::vector<Pose2> poses;
  for (const Pose2& pose : drive(10000))
    poses.push_back({30.0 * pose.x, 30.0 * pose.y, pose.theta});
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(draw_trajectory(file("run.png"), plan, run_along(poses), poses));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_LT(taken.count(), 20.0);  // about 0.5 s; sanitizers and shared machines take their part
  ASSERT_TRUE(draw_trajectory(file("run.svg"), plan, run_along(poses), poses));
  EXPECT_LT(fs::file_size(file("run.svg")), 6000000U);
}

}  // namespace
}  // namespace adit
