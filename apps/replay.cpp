#include "replay.hpp"

#include <algorithm>
#include <cmath>

#include "adit/config/fields.hpp"
#include "adit/extraction/noise_estimate.hpp"
#include "progress.hpp"

namespace adit {
namespace {

constexpr const char* kConfigured = "configuration";
constexpr const char* kFromFields = "the log's own fields";
constexpr const char* kEstimated = "estimated from the log";
constexpr const char* kDefault = "default";
constexpr std::size_t kScansToLearnFrom = 200;
constexpr double kBestSigma = 1e-3;  // m; no scanner of mines is better, whatever a log shows

/// The scatter of scans spread evenly over the log.
std::optional<ScatterEstimate> scatter_of(const Log& log) {
  ScatterEstimator estimator;
  const std::size_t stride = std::max<std::size_t>(1, log.scans.size() / kScansToLearnFrom);
  for (std::size_t i = 0; i < log.scans.size(); i += stride) estimator.add(log.scans[i].scan);
  return estimator.estimate();
}

double longest_range(const Log& log) {
  double longest = 0.0;
  for (const LogScan& scan : log.scans) longest = std::max(longest, scan.scan.max_range);
  return longest;
}

const char* words_for(RangeSource source) {
  switch (source) {
    case RangeSource::configuration:
      return kConfigured;
    case RangeSource::parameter:
      return "the log's PARAM lines";
    case RangeSource::field:
      return kFromFields;
    case RangeSource::found:
      return "found in the log's ranges";
    case RangeSource::assumed:
      break;
  }
  return "assumed: above every range of the log";
}

/// Where the maximum range of the laser that sees farthest comes from.
const char* source_of_range(const Log& log) {
  const auto& lasers = log.summary.lasers;
  const auto farthest =
      std::max_element(lasers.begin(), lasers.end(),
                       [](const auto& a, const auto& b) { return a.max_range < b.max_range; });
  return farthest == lasers.end() ? kFromFields : words_for(farthest->max_range_source);
}

/// The keys whose values and sources are reported even where nothing is known of them.
bool is_reported(const ConfigField& field) {
  const std::string name = field.name();
  return field.table == "scanner" || field.table == "odometry" || name == "map.sigma_m" ||
         name == "extraction.roughness_m";
}

}  // namespace

ReplaySettings settle(const LoadedConfiguration& loaded, const Log& log) {
  ReplaySettings settings{loaded.values, {}};
  ScannerModel& scanner = settings.configuration.localizer.scanner;
  ExtractionOptions& extraction = settings.configuration.localizer.extraction;
  for (const std::string& key : loaded.given) settings.sources[key] = kConfigured;
  const auto open = [&](const char* key, const char* source) {
    if (loaded.has(key)) return false;
    settings.sources[key] = source;
    return true;
  };
  if (open("scanner.max_range_m", source_of_range(log))) scanner.max_range_m = longest_range(log);
  if (!loaded.has("scanner.quantisation_m")) {
    const auto step = find_range_step(log, log.scans.front().laser);
    open("scanner.quantisation_m", step ? kEstimated : kDefault);
    if (step) scanner.quantisation_m = *step;
  }
  const std::optional<ScatterEstimate> scatter = scatter_of(log);
  const char* source = scatter ? kEstimated : kDefault;
  if (open("scanner.range_sigma_m", source) && scatter) {
    const double rounding = scanner.quantisation_m * scanner.quantisation_m / 12.0;
    const double variance = scatter->beam_sigma_m * scatter->beam_sigma_m - rounding;
    const double least = std::max(0.25 * rounding, kBestSigma * kBestSigma);
    scanner.range_sigma_m = std::sqrt(std::max(variance, least));
  }
  if (open("extraction.roughness_m", source) && scatter) {
    extraction.roughness_m = scatter->roughness_m;
  }
  for (const ConfigField& field : fields_of(settings.configuration)) {
    if (is_reported(field)) settings.sources.try_emplace(field.name(), kDefault);
  }
  return settings;
}

Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const std::optional<Pose2>& start) {
  Replay result;
  Localizer localizer(map, settings);
  localizer.start(start.value_or(log.scans.front().odom_from_vehicle));
  Progress progress("localizing", log.scans.size());
  for (const LogScan& scan : log.scans) {
    result.rows.push_back(to_row(localizer.update(scan.scan, scan.odom_from_vehicle)));
    result.timings.push_back(localizer.timings());
    result.search_calls.push_back(localizer.match().calls);
    progress.advance();
  }
  return result;
}

}  // namespace adit
