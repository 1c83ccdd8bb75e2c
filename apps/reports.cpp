#include "reports.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "adit/config/fields.hpp"

namespace adit {
namespace {

constexpr std::array kStatuses = {Status::ok, Status::degraded, Status::ambiguous, Status::lost};

std::int64_t count_of(const Replay& replay, Status status) {
  return std::count_if(replay.rows.begin(), replay.rows.end(),
                       [&](const EstimateRow& row) { return row.status == status; });
}

Json value_of(const ConfigField& field) {
  if (const auto* words = std::get_if<WordField>(&field.target)) return words->get();
  if (const auto* number = std::get_if<double*>(&field.target)) return **number;
  if (const auto* count = std::get_if<int*>(&field.target)) return **count;
  return *std::get<bool*>(field.target);
}

Json settings_report(const ReplaySettings& settings) {
  Json json = Json::object();
  Configuration configuration = settings.configuration;
  for (const ConfigField& field : fields_of(configuration)) {
    const auto source = settings.sources.find(field.name());
    if (source == settings.sources.end()) continue;
    Json& entry = json[field.name()];
    entry["value"] = value_of(field);
    entry["source"] = source->second;
  }
  return json;
}

Json log_report(const LogSummary& log) {
  Json json = Json::object();
  json["lines"] = log.lines;
  json["scans"] = log.scans();
  json["lasers"] = Json::array();
  for (const LaserSummary& laser : log.lasers) {
    Json entry = Json::object();
    entry["laser"] = to_string(laser.laser);
    entry["scans"] = laser.scans;
    entry["fewest_beams"] = laser.fewest_beams;
    entry["most_beams"] = laser.most_beams;
    entry["max_range_m"] = laser.max_range;
    entry["max_range_source"] = to_string(laser.max_range_source);
    json["lasers"].push_back(std::move(entry));
  }
  json["warnings"] = Json::array();
  for (const Warning& warning : log.warnings) json["warnings"].push_back(to_string(warning));
  return json;
}

template <class Value>
Json spread(std::vector<Value> values, double unit) {
  Json json = Json::object();
  if (values.empty()) return json;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return unit * static_cast<double>(
                      values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))]);
  };
  json["median"] = at(0.5);
  json["p99"] = at(0.99);
  json["max"] = at(1.0);
  return json;
}

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

Json localize_report(const std::string& estimator, const ReplaySettings& settings,
                     const MapReport& cleaning, const LogSummary& log, const Replay& replay) {
  Json json = Json::object();
  json["estimator"] = estimator;
  json["scans"] = replay.rows.size();
  for (const Status status : kStatuses) {
    json["by_status"][to_string(status)] = count_of(replay, status);
  }
  json["settings"] = settings_report(settings);
  json["map"] = cleaning_report(cleaning);
  json["log"] = log_report(log);
  std::vector<int> pairs;
  for (const EstimateRow& row : replay.rows) pairs.push_back(row.pairs);
  json["pairs"] = spread(pairs, 1.0);
  json["search_calls"] = spread(replay.search_calls, 1.0);
  return json;
}

Json timings_report(const std::vector<Timings>& timings) {
  std::vector<double> prediction, extraction, matching, estimation, total;
  for (const Timings& t : timings) {
    prediction.push_back(t.prediction);
    extraction.push_back(t.extraction);
    matching.push_back(t.matching);
    estimation.push_back(t.estimation);
    total.push_back(t.total());
  }
  constexpr double kMicroseconds = 1e6;
  Json json = Json::object();
  json["unit"] = "microseconds";
  json["prediction"] = spread(std::move(prediction), kMicroseconds);
  json["extraction"] = spread(std::move(extraction), kMicroseconds);
  json["matching"] = spread(std::move(matching), kMicroseconds);
  json["estimation"] = spread(std::move(estimation), kMicroseconds);
  json["cycle"] = spread(std::move(total), kMicroseconds);
  return json;
}

std::string localize_summary(const Replay& replay) {
  std::string text = fmt::format("{} scans:", replay.rows.size());
  for (const Status status : kStatuses) {
    text += fmt::format(" {} {},", count_of(replay, status), to_string(status));
  }
  text.back() = '\n';
  return text;
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
