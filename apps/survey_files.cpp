#include "survey_files.hpp"

#include <fmt/core.h>

#include "adit/io/atomic_file.hpp"
#include "adit/plot/survey_figures.hpp"
#include "localize_report.hpp"

namespace adit {
namespace {

Json segments_report(const std::vector<Segment>& segments) {
  Json json = Json::array();
  for (const Segment& s : segments) {
    Json row = Json::array();
    for (const double x : {s.a.x(), s.a.y(), s.b.x(), s.b.y()}) row.push_back(x);
    json.push_back(std::move(row));
  }
  return json;
}

Json support_report(const WallSupport& support) {
  Json json = Json::object();
  json["hits"] = support.hits;
  json["scans"] = support.scans;
  json["visits"] = support.visits;
  return json;
}

Json walls_report(const WallMap& walls) {
  std::size_t pieces = 0;
  double length = 0.0;
  for (const auto& line : walls.lines) {
    pieces += line.pieces.size();
    length += line.length();
  }
  Json json = Json::object();
  json["lines"] = walls.lines.size();
  json["segments"] = pieces;
  json["length_m"] = length;
  return json;
}

Json closures_report(const Surveyed& surveyed) {
  Json json = Json::array();
  for (const SurveyClosure& c : surveyed.closures) {
    Json row = Json::object();
    row["earlier_s"] = surveyed.trajectory[c.earlier].stamp;
    row["later_s"] = surveyed.trajectory[c.later].stamp;
    row["x"] = c.earlier_from_later.x;
    row["y"] = c.earlier_from_later.y;
    row["theta"] = c.earlier_from_later.theta;
    json.push_back(std::move(row));
  }
  return json;
}

std::string segment_text(const Segment& s) {
  return fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}", s.a.x(), s.a.y(), s.b.x(), s.b.y());
}

std::string covariance_text(const Matrix2d& m) {
  return fmt::format("{:.4g},{:.4g},{:.4g}", m(0, 0), m(0, 1), m(1, 1));
}

}  // namespace

Json changes_report(const PlanDifference& difference) {
  Json json = Json::object();
  json["confirmed_m"] = difference.confirmed_m;
  json["unseen_m"] = difference.unseen_m;
  json["changes"] = Json::array();
  int number = 0;
  for (const PlanChangeItem& item : difference.items) {
    Json row = Json::object();
    row["number"] = ++number;
    row["change"] = to_string(item.change);
    row["length_m"] = item.length_m;
    row["offset_m"] = item.offset_m;
    row["seen_through"] = item.seen_through;
    row["support"] = support_report(item.support);
    row["removed"] = segments_report(item.removed);
    row["added"] = segments_report(item.added);
    json["changes"].push_back(std::move(row));
  }
  return json;
}

Json survey_report(const Surveyed& surveyed) {
  Json json = Json::object();
  json["scans"] = surveyed.trajectory.size();
  json["scans_of_other_lasers"] = surveyed.of_other_lasers;
  json["walls"] = walls_report(surveyed.walls);
  if (surveyed.stations.empty()) {
    json["keyframes"] = surveyed.keyframes;
    json["pairs"] = surveyed.pairs;
    json["closures"] = closures_report(surveyed);
  } else {
    json["stations"] = surveyed.stations.size();
    json["scans_by_station"] = surveyed.by_station;
    json["without_heading"] = Json::array();
    for (const Vector2d& p : surveyed.unplaced) {
      Json row = Json::array();
      for (const double x : {p.x(), p.y()}) row.push_back(x);
      json["without_heading"].push_back(std::move(row));
    }
  }
  if (surveyed.difference) json["difference"] = changes_report(*surveyed.difference);
  json["settings"] = settings_report(surveyed.settings);
  json["log"] = log_report(surveyed.log, surveyed.settings);
  return json;
}

Result<void> write_walls(const WallMap& walls, const std::string& path) {
  std::string text =
      "x1,y1,x2,y2,line,offset_sigma_m,angle_sigma_rad,scatter_m,hits,scans,visits,"
      "xx1,xy1,yy1,xx2,xy2,yy2\n";
  std::size_t number = 0;
  for (const auto& line : walls.lines) {
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
      const SurveyedWall& wall = line.pieces[i];
      text += fmt::format(
          "{},{},{:.5f},{:.6f},{:.4f},{:.0f},{},{},{},{}\n", segment_text(wall.segment), number,
          wall.offset_sigma_m(), wall.angle_sigma_rad(), wall.scatter_m, wall.support.hits,
          wall.support.scans, wall.support.visits, covariance_text(line.covariances[i]),
          covariance_text(line.covariances[i + 1]));
    }
    ++number;
  }
  return write_file(path, text);
}

Result<void> write_changes(const PlanDifference& difference, const std::string& path) {
  if (!path.ends_with(".csv")) return write_json(changes_report(difference), path);
  std::string text = "number,change,action,x1,y1,x2,y2,offset_m,seen_through,hits,scans,visits\n";
  int number = 0;
  for (const PlanChangeItem& item : difference.items) {
    ++number;
    const auto add = [&](const char* action, const Segment& s) {
      text +=
          fmt::format("{},{},{},{},{:.3f},{:.2f},{:.0f},{},{}\n", number, to_string(item.change),
                      action, segment_text(s), item.offset_m, item.seen_through, item.support.hits,
                      item.support.scans, item.support.visits);
    };
    for (const Segment& s : item.removed) add("removed", s);
    for (const Segment& s : item.added) add("added", s);
  }
  return write_file(path, text);
}

Result<void> draw_surveyed(const Surveyed& surveyed, const std::string& path) {
  PictureOptions options;
  options.axes = true;
  if (surveyed.difference) {
    std::vector<DrawnChange> changes;
    for (const PlanChangeItem& item : surveyed.difference->items) {
      changes.push_back({to_string(item.change), item.removed, item.added});
    }
    return draw_plan_changes(path, surveyed.plan, changes, options);
  }
  std::vector<DrawnWall> walls;
  for (const auto& line : surveyed.walls.lines) {
    for (const SurveyedWall& wall : line.pieces) {
      walls.push_back({wall.segment, wall.offset_sigma_m(), wall.angle_sigma_rad()});
    }
  }
  std::vector<Pose2> trajectory;
  for (const StampedPose& pose : surveyed.trajectory) trajectory.push_back(pose.pose);
  std::vector<DrawnClosure> closures;
  for (const SurveyClosure& c : surveyed.closures) {
    closures.push_back({trajectory[c.earlier].translation(), trajectory[c.later].translation()});
  }
  const bool drives = surveyed.stations.empty();
  const SurveyView view{walls,
                        drives ? std::span<const Pose2>(trajectory) : std::span<const Pose2>(),
                        surveyed.stations, closures};
  return draw_survey(path, view, options);
}

std::string changes_summary(const PlanDifference& difference) {
  std::string text;
  int number = 0;
  for (const PlanChangeItem& item : difference.items) {
    const auto& pieces = item.added.empty() ? item.removed : item.added;
    ++number;
    if (pieces.empty()) continue;
    const Segment& middle = pieces[pieces.size() / 2];
    const Vector2d at = 0.5 * (middle.a + middle.b);
    text += fmt::format("{:4} {:12} {:7.2f} m at {:.2f}, {:.2f}", number, to_string(item.change),
                        item.length_m, at.x(), at.y());
    if (item.change == PlanChange::moved) text += fmt::format(", by {:.2f} m", item.offset_m);
    text += '\n';
  }
  text += fmt::format("{} changes; of the plan {:.1f} m confirmed, {:.1f} m not seen\n",
                      difference.items.size(), difference.confirmed_m, difference.unseen_m);
  return text;
}

}  // namespace adit
