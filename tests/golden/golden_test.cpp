// A run whose estimates are committed: any change of the numbers shows here. Where the change is
// meant, ADIT_REWRITE_GOLDEN=1 writes the file anew.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "support/mockup_run.hpp"

namespace adit {
namespace {

// Compilers differ in the last bits only, the file in the tenth digit.
constexpr double kTolerance = 1e-6;            // s, m, rad
constexpr double kCovarianceTolerance = 1e-9;  // m², m rad, rad²

struct Row {
  double stamp = 0.0;
  std::array<double, 9> numbers{};  // pose and upper triangle of the covariance
  std::string status;
  int pairs = 0;
};

std::vector<Row> run(std::uint64_t seed) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(seed, 8);
  Localizer localizer(map, test::mockup_settings());
  localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(recording.scans[i], recording.odometry[i]);
    const Matrix3d& c = e.covariance;
    rows.push_back(
        {e.stamp,
         {e.pose.x, e.pose.y, e.pose.theta, c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)},
         to_string(e.status),
         static_cast<int>(e.pairs.size())});
  }
  return rows;
}

void write(const std::vector<Row>& rows, const std::string& path) {
  std::ofstream out(path);
  out << "t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,status,pairs\n";
  out.precision(10);
  for (const Row& row : rows) {
    out << row.stamp;
    for (const double number : row.numbers) out << ',' << number;
    out << ',' << row.status << ',' << row.pairs << '\n';
  }
  ASSERT_TRUE(out.flush()) << "cannot write " << path;
}

std::vector<Row> read(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row;
    char comma = 0;
    fields >> row.stamp >> comma;
    for (double& number : row.numbers) fields >> number >> comma;
    std::getline(fields, row.status, ',');
    fields >> row.pairs;
    EXPECT_TRUE(fields) << path << ": " << line;
    rows.push_back(row);
  }
  return rows;
}

TEST(Golden, MockupRun) {
  const std::string path = std::string(ADIT_GOLDEN_FOLDER) + "/mockup_seed_7.csv";
  const std::vector<Row> rows = run(7);
  if (std::getenv("ADIT_REWRITE_GOLDEN") != nullptr) {
    write(rows, path);
    GTEST_SKIP() << "wrote " << path;
  }
  const std::vector<Row> golden = read(path);
  ASSERT_EQ(rows.size(), golden.size()) << path;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE("row " + std::to_string(i));
    EXPECT_NEAR(rows[i].stamp, golden[i].stamp, kTolerance);
    for (std::size_t k = 0; k < rows[i].numbers.size(); ++k) {
      const double tolerance = k < 3 ? kTolerance : kCovarianceTolerance;
      EXPECT_NEAR(rows[i].numbers[k], golden[i].numbers[k], tolerance) << "column " << k + 1;
    }
    EXPECT_EQ(rows[i].status, golden[i].status);
    EXPECT_EQ(rows[i].pairs, golden[i].pairs);
  }
}

}  // namespace
}  // namespace adit
