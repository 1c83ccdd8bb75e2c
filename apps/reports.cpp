#include "reports.hpp"

#include <array>

namespace adit {
namespace {

constexpr std::array kStatuses = {Status::ok, Status::degraded, Status::ambiguous, Status::lost};

Json statistics_report(const Statistics& statistics) {
  Json json = Json::object();
  json["mean"] = statistics.mean;
  json["rms"] = statistics.rms;
  json["median"] = statistics.median;
  json["p95"] = statistics.p95;
  json["p99"] = statistics.p99;
  json["max"] = statistics.max;
  return json;
}

Json nees_report(const ConsistencyFigures& nees) {
  Json json = Json::object();
  json["per_dof"] = nees.per_dof;
  json["count"] = nees.count;
  json["coverage_95"] = nees.coverage_95;
  json["axis_coverage_95"] = Json::array();
  for (const double coverage : nees.axis_coverage_95) {
    json["axis_coverage_95"].push_back(coverage);
  }
  json["mean_log_likelihood"] = nees.mean_log_likelihood;
  json["partial"] = nees.partial;
  json["unknown"] = nees.unknown;
  json["invalid"] = nees.invalid;
  return json;
}

}  // namespace

Json cleaning_report(const MapReport& cleaning) {
  Json json = Json::object();
  json["input"] = cleaning.input;
  json["not_finite"] = cleaning.not_finite;
  json["zero_length"] = cleaning.zero_length;
  json["snapped_ends"] = cleaning.snapped_ends;
  json["crossings"] = cleaning.crossings;
  json["t_junctions"] = cleaning.t_junctions;
  json["duplicates"] = cleaning.duplicates;
  json["merged"] = cleaning.merged;
  json["output"] = cleaning.output;
  return json;
}

Json evaluation_report(const EvaluationReport& report) {
  Json json = Json::object();
  json["estimates"] = report.estimates;
  json["joined"] = report.joined;
  json["missing"] = report.missing;
  json["without_truth"] = report.without_truth;
  json["not_finite"] = report.not_finite;
  json["position"] = statistics_report(report.position);
  json["heading_deg"] = statistics_report(report.heading_deg);
  json["beyond_lost"] = report.beyond_lost;
  if (report.first_lost_stamp) json["first_lost_stamp"] = *report.first_lost_stamp;
  json["confidently_wrong"] = report.confidently_wrong;
  // A bare trajectory states no status: zeros, for scripts that expect the object.
  StatusCounts counts = report.by_status.value_or(StatusCounts{});
  for (const Status status : kStatuses) json["by_status"][to_string(status)] = counts[status];
  if (report.nees) json["nees"] = nees_report(*report.nees);
  if (report.nees_ok) json["nees_ok"] = nees_report(*report.nees_ok);
  if (report.protection) {
    json["protection"]["count"] = report.protection->count;
    json["protection"]["exceeded"] = report.protection->exceeded;
    json["protection"]["level_m"] = statistics_report(report.protection->level);
  }
  if (report.relations) {
    const RelationsMetric& relations = *report.relations;
    Json& entry = json["relations"];
    entry["count"] = relations.count;
    entry["matched"] = relations.matched;
    entry["translation_mean"] = relations.translation_mean;
    entry["translation_std"] = relations.translation_std;
    entry["translation_max"] = relations.translation_max;
    entry["rotation_mean_deg"] = relations.rotation_mean_deg;
    entry["rotation_std_deg"] = relations.rotation_std_deg;
  }
  return json;
}

}  // namespace adit
