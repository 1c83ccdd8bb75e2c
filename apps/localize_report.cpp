#include "localize_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adit/config/enum_names.hpp"
#include "adit/config/fields.hpp"
#include "adit/evaluation/statistics.hpp"
#include "reports.hpp"

namespace adit {
namespace {

constexpr std::array kStatuses = {Status::ok, Status::degraded, Status::ambiguous, Status::lost};

std::int64_t count_of(const Replay& replay, Status status) {
  return std::count_if(replay.rows.begin(), replay.rows.end(),
                       [&](const EstimateRow& row) { return row.status == status; });
}

/// The scans whose pose may be trusted: how sure they say that they are.
struct Trusted {
  std::vector<double> sigma_m;  ///< root mean square distance
  std::vector<double> sigma_rad;
  std::vector<double> protection_m;  ///< where a level is given
  std::int64_t unprotected = 0;      ///< where none is
};

Trusted trusted_rows(const Replay& replay) {
  Trusted trusted;
  for (const EstimateRow& row : replay.rows) {
    if (row.status != Status::ok && row.status != Status::degraded) continue;
    trusted.sigma_m.push_back(std::sqrt(row.covariance.topLeftCorner<2, 2>().trace()));
    trusted.sigma_rad.push_back(std::sqrt(row.covariance(2, 2)));
    if (std::isfinite(row.protection_m)) {
      trusted.protection_m.push_back(row.protection_m);
    } else {
      ++trusted.unprotected;
    }
  }
  return trusted;
}

Json value_of(const ConfigField& field) {
  if (const auto* words = std::get_if<WordField>(&field.target)) return words->get();
  if (const auto* number = std::get_if<double*>(&field.target)) return **number;
  if (const auto* count = std::get_if<int*>(&field.target)) return **count;
  return *std::get<bool*>(field.target);
}

Json laser_report(const LaserSummary& laser, const ScannerModel& scanner,
                  const ScannerSources& sources) {
  Json json = Json::object();
  json["laser"] = to_string(laser.laser);
  json["scans"] = laser.scans;
  json["fewest_beams"] = laser.fewest_beams;
  json["most_beams"] = laser.most_beams;
  json["max_range_m"] = laser.max_range;
  json["max_range_source"] = to_string(laser.max_range_source);
  json["range_sigma_m"] = scanner.range_sigma_m;
  json["range_sigma_source"] = sources.range_sigma_m;
  json["quantisation_m"] = scanner.quantisation_m;
  json["quantisation_source"] = sources.quantisation_m;
  return json;
}

Json stamps_report(const StampCounts& stamps) {
  Json json = Json::object();
  json["duplicates"] = stamps.duplicates;
  json["late"] = stamps.late;
  json["gaps"] = stamps.gaps;
  json["jumps"] = stamps.jumps;
  return json;
}

/// Medians and 95th percentiles over the scans that are ok or degraded.
Json certainty_report(const Trusted& trusted) {
  Json json = Json::object();
  const auto add = [&](const char* name, const Statistics& statistics) {
    json[name]["median"] = statistics.median;
    json[name]["p95"] = statistics.p95;
  };
  add("sigma_position_m", summarise(trusted.sigma_m));
  add("sigma_heading_rad", summarise(trusted.sigma_rad));
  add("protection_m", summarise(trusted.protection_m));
  json["without_protection"] = trusted.unprotected;
  return json;
}

Json map_error_report(const MapError& error, const std::string& source) {
  Json json = Json::object();
  json["offset_sigma_m"] = error.offset_sigma_m;
  json["length_m"] = error.length_m;
  json["roughness_sigma_m"] = error.roughness_sigma_m;
  json["distortion_ratio"] = error.distortion_ratio;
  json["source"] = source;
  return json;
}

template <class Value>
Json spread(const std::vector<Value>& values, double unit) {
  Json json = Json::object();
  if (values.empty()) return json;
  std::vector<double> ascending;
  for (const Value value : values) ascending.push_back(unit * static_cast<double>(value));
  std::sort(ascending.begin(), ascending.end());
  json["median"] = percentile(ascending, 0.5);
  json["p99"] = percentile(ascending, 0.99);
  json["max"] = ascending.back();
  return json;
}

}  // namespace

Json settings_report(const LogSettings& settings) {
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

Json log_report(const LogSummary& log, const LogSettings& settings) {
  Json json = Json::object();
  json["lines"] = log.lines;
  json["scans"] = log.scans();
  json["lasers"] = Json::array();
  LaserScan scan;
  for (std::size_t i = 0; i < log.lasers.size(); ++i) {
    scan.scanner = static_cast<int>(i);
    json["lasers"].push_back(laser_report(
        log.lasers[i], settings.configuration.localizer.scanner_of(scan), settings.lasers[i]));
  }
  json["warnings"] = Json::array();
  for (const Warning& warning : log.warnings) json["warnings"].push_back(to_string(warning));
  return json;
}

Json localize_report(const LogSettings& settings, const MapReport& cleaning, const LogSummary& log,
                     const RunOrigin& origin, const Replay& replay) {
  Json json = Json::object();
  json["estimator"] = word_of(settings.configuration.localizer.estimator);
  json["start"] = origin.start;
  if (!origin.level.empty()) json["level"] = origin.level;
  json["scans"] = replay.rows.size();
  for (const Status status : kStatuses) {
    json["by_status"][to_string(status)] = count_of(replay, status);
  }
  json["certainty"] = certainty_report(trusted_rows(replay));
  json["stamps"] = stamps_report(replay.stamps);
  json["map_error"] = map_error_report(replay.map_error, settings.sources.at("map.sigma_m"));
  json["settings"] = settings_report(settings);
  json["map"] = cleaning_report(cleaning);
  json["log"] = log_report(log, settings);
  std::vector<int> pairs;
  for (const EstimateRow& row : replay.rows) pairs.push_back(row.pairs);
  json["pairs"] = spread(pairs, 1.0);
  json["search_calls"] = spread(replay.search_calls, 1.0);
  return json;
}

Json timings_report(const std::vector<Timings>& timings) {
  constexpr double kMicroseconds = 1e6;
  Json json = Json::object();
  json["unit"] = "microseconds";
  const auto add = [&](const char* name, auto&& seconds_of) {
    std::vector<double> seconds;  // a stage that a scan did not need took none
    for (const Timings& t : timings) {
      if (seconds_of(t) > 0.0) seconds.push_back(seconds_of(t));
    }
    json[name] = spread(seconds, kMicroseconds);
    json[name]["scans"] = seconds.size();
  };
  add("deskew", [](const Timings& t) { return t.deskew; });
  add("prediction", [](const Timings& t) { return t.prediction; });
  add("extraction", [](const Timings& t) { return t.extraction; });
  add("matching", [](const Timings& t) { return t.matching; });
  add("estimation", [](const Timings& t) { return t.estimation; });
  add("refinement", [](const Timings& t) { return t.refinement; });
  add("search", [](const Timings& t) { return t.search; });
  add("tracking", [](const Timings& t) { return t.tracking; });
  add("cycle", [](const Timings& t) { return t.total(); });
  return json;
}

std::string localize_summary(const Replay& replay) {
  std::string text = fmt::format("{} scans:", replay.rows.size());
  for (const Status status : kStatuses) {
    text += fmt::format(" {} {},", count_of(replay, status), to_string(status));
  }
  text.back() = '\n';
  const Trusted trusted = trusted_rows(replay);
  if (!trusted.sigma_m.empty()) {
    text +=
        fmt::format("sigma {:.3f} m, {:.2f} degrees (median)", summarise(trusted.sigma_m).median,
                    degrees(summarise(trusted.sigma_rad).median));
    const Statistics level = summarise(trusted.protection_m);
    if (level.count > 0) {
      text += fmt::format("; protection level {:.3f} m (median), {:.3f} m (95 %)", level.median,
                          level.p95);
    }
    text += '\n';
  }
  const StampCounts& stamps = replay.stamps;
  if (stamps.duplicates + stamps.late + stamps.gaps + stamps.jumps > 0) {
    text += fmt::format("stamps: {} twice, {} late, {} after a gap, {} after a jump of the clock\n",
                        stamps.duplicates, stamps.late, stamps.gaps, stamps.jumps);
  }
  return text;
}

}  // namespace adit
