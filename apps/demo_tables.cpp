#include "demo_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "adit/simulation/paper_run.hpp"

namespace adit {
namespace {

struct Errors {
  double sum = 0.0;
  double largest = 0.0;
  int count = 0;
  void add(double error) {
    sum += error;
    largest = std::max(largest, error);
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0.0; }
};

double heading_degrees(double theta) { return degrees(wrap_positive(theta)); }

}  // namespace

std::string demo_tables(const std::vector<StampedPose>& truth,
                        const std::vector<EstimateRow>& rows) {
  Errors paper_position, our_position, paper_heading, our_heading;
  std::string text =
      "Table I: positions (m)                                  errors (m)\n"
      " surveyed x, y    the paper's x, y      our x, y       paper   ours   (1 sigma)\n";
  for (std::size_t i = 0; i < kPaperRun.size() && i < rows.size(); ++i) {
    const PaperRow& row = kPaperRun[i];
    const Pose2& ours = rows[i].pose;
    const double theirs =
        std::hypot(row.estimated_x - row.surveyed_x, row.estimated_y - row.surveyed_y);
    const double error = (ours.translation() - truth[i].pose.translation()).norm();
    paper_position.add(theirs);
    our_position.add(error);
    text += fmt::format(
        "{:7.3f} {:7.3f}   {:7.3f} {:7.3f}   {:7.3f} {:7.3f}    {:6.3f} {:6.3f}    {:6.3f}\n",
        row.surveyed_x, row.surveyed_y, row.estimated_x, row.estimated_y, ours.x, ours.y, theirs,
        error, std::sqrt(rows[i].covariance.topLeftCorner<2, 2>().trace()));
  }
  text +=
      "\nTable II: headings (degrees)              errors (degrees)\n"
      "    gyro   the paper's     ours           paper   ours   (1 sigma)\n";
  for (std::size_t i = 0; i < kPaperRun.size() && i < rows.size(); ++i) {
    const PaperRow& row = kPaperRun[i];
    const double error = std::abs(degrees(angle_between(truth[i].pose.theta, rows[i].pose.theta)));
    our_heading.add(error);
    std::string gyro = "-", theirs = "-";
    if (row.gyro_deg) {
      const double difference = std::abs(row.estimated_deg - *row.gyro_deg);
      paper_heading.add(difference);
      gyro = fmt::format("{:.3f}", *row.gyro_deg);
      theirs = fmt::format("{:.3f}", difference);
    }
    text += fmt::format("{:>8}      {:8.3f} {:8.3f}          {:>6} {:6.3f}    {:6.3f}\n", gyro,
                        row.estimated_deg, heading_degrees(rows[i].pose.theta), theirs, error,
                        degrees(std::sqrt(rows[i].covariance(2, 2))));
  }
  text += fmt::format(
      "\n                       mean     largest\n"
      "position, the paper  {:7.3f}   {:7.3f} m      (real mockup, 1992)\n"
      "position, adit       {:7.3f}   {:7.3f} m      (simulated mockup)\n"
      "heading, the paper   {:7.3f}   {:7.3f} degrees\n"
      "heading, adit        {:7.3f}   {:7.3f} degrees\n",
      paper_position.mean(), paper_position.largest, our_position.mean(), our_position.largest,
      paper_heading.mean(), paper_heading.largest, our_heading.mean(), our_heading.largest);
  return text;
}

}  // namespace adit
