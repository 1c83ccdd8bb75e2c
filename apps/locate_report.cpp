#include "locate_report.hpp"

#include <fmt/core.h>

#include <cmath>

#include "adit/io/saved_pose.hpp"

namespace adit {

Json locate_json(const MineAnswer& answer, const std::vector<MineLevel>& levels) {
  Json json = Json::object();
  json["status"] = to_string(answer.verdict);
  json["poses"] = Json::array();
  for (const LevelPose& pose : answer.poses) {
    Json entry = Json::object();
    entry["x"] = pose.ranked.pose.x;
    entry["y"] = pose.ranked.pose.y;
    entry["theta"] = pose.ranked.pose.theta;
    entry["weight"] = pose.ranked.weight;
    entry["cov"] = Json::array();
    for (const double value : upper_triangle(pose.ranked.covariance)) entry["cov"].push_back(value);
    const std::string& level = levels[pose.level].name;
    if (!level.empty()) entry["level"] = level;
    json["poses"].push_back(std::move(entry));
  }
  json["elapsed_s"] = answer.elapsed_s;
  return json;
}

std::string locate_table(std::size_t index, const MineAnswer& answer,
                         const std::vector<MineLevel>& levels) {
  std::string text = fmt::format("scan {}: {}, {} {}, {:.3f} s\n", index, to_string(answer.verdict),
                                 answer.poses.size(), answer.poses.size() == 1 ? "pose" : "poses",
                                 answer.elapsed_s);
  if (answer.poses.empty()) return text;
  text += fmt::format("{:>4} {:>8} {:>12} {:>12} {:>10} {:>8} {:>8} {:>9}\n", "", "weight", "x [m]",
                      "y [m]", "head [deg]", "sigma x", "sigma y", "sigma deg");
  for (std::size_t i = 0; i < answer.poses.size(); ++i) {
    const RankedPose& pose = answer.poses[i].ranked;
    const Vector3d sigma = pose.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    text += fmt::format("{:>4} {:>8.4f} {:>12.3f} {:>12.3f} {:>10.2f} {:>8.3f} {:>8.3f} {:>9.2f}",
                        i + 1, pose.weight, pose.pose.x, pose.pose.y, degrees(pose.pose.theta),
                        sigma.x(), sigma.y(), degrees(sigma.z()));
    const std::string& level = levels[answer.poses[i].level].name;
    text += level.empty() ? "\n" : "  " + level + "\n";
  }
  return text;
}

}  // namespace adit
