#include <cinttypes>
#include <cstdarg>
#include <cstdio>

#include "adit/evaluation/report.hpp"

namespace adit {
namespace {

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void append(std::string& text, const char* format, ...) {
  char line[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

void append_counts(std::string& text, const EvaluationReport& report) {
  append(text, "rows       %" PRId64 " estimates, %" PRId64 " truth poses, %" PRId64 " joined",
         report.estimates, report.truth, report.joined);
  if (report.truth > 0) {
    append(text, ", %" PRId64 " truth poses missing, %" PRId64 " rows without truth",
           report.missing, report.without_truth);
  }
  if (report.not_finite > 0) append(text, ", %" PRId64 " not finite", report.not_finite);
  text += "\n";
  if (!report.by_status) return;
  const StatusCounts& counts = *report.by_status;
  append(text,
         "status     ok %" PRId64 ", degraded %" PRId64 ", ambiguous %" PRId64 ", lost %" PRId64
         "\n",
         counts.ok, counts.degraded, counts.ambiguous, counts.lost);
}

void append_statistics(std::string& text, const char* name, const Statistics& s) {
  append(text, "%-15s %9.4f %9.4f %9.4f %9.4f %9.4f %9.4f\n", name, s.mean, s.rms, s.median, s.p95,
         s.p99, s.max);
}

void append_errors(std::string& text, const EvaluationReport& report) {
  if (report.joined == 0) return;
  append(text, "%-15s %9s %9s %9s %9s %9s %9s\n", "error", "mean", "rms", "median", "p95", "p99",
         "max");
  append_statistics(text, "position (m)", report.position);
  append_statistics(text, "heading (deg)", report.heading_deg);
  if (!report.first_lost_stamp) {
    text += "lost       never\n";
    return;
  }
  append(text, "lost       first at %.6f, %" PRId64 " rows, %" PRId64 " of them with status ok\n",
         *report.first_lost_stamp, report.beyond_lost, report.confidently_wrong);
}

void append_consistency(std::string& text, const char* name, const ConsistencyFigures& c) {
  append(text, "%-10s %.3f per degree of freedom over %" PRId64 " rows", name, c.per_dof, c.count);
  if (c.partial > 0) append(text, " (%" PRId64 " partly unknown)", c.partial);
  if (c.unknown > 0) append(text, ", %" PRId64 " unknown", c.unknown);
  if (c.invalid > 0) append(text, ", %" PRId64 " not a covariance", c.invalid);
  append(text, "; mean log-likelihood %.3f\n", c.mean_log_likelihood);
  append(text, "%-10s 95 %% region covers %.1f %%; x %.1f %%, y %.1f %%, heading %.1f %%\n", "",
         100.0 * c.coverage_95, 100.0 * c.axis_coverage_95.x(), 100.0 * c.axis_coverage_95.y(),
         100.0 * c.axis_coverage_95.z());
}

void append_relations(std::string& text, const RelationsMetric& r) {
  append(text, "relations  %" PRId64 " of %" PRId64 " matched", r.matched, r.count);
  if (r.matched > 0) {
    append(text, "; translation %.4f +- %.4f m (max %.4f), rotation %.4f +- %.4f deg (max %.4f)",
           r.translation_mean, r.translation_std, r.translation_max, r.rotation_mean_deg,
           r.rotation_std_deg, r.rotation_max_deg);
  }
  text += "\n";
}

}  // namespace

std::string to_text(const EvaluationReport& report) {
  std::string text;
  append_counts(text, report);
  append_errors(text, report);
  if (report.nees) append_consistency(text, "NEES", *report.nees);
  if (report.nees_ok) append_consistency(text, "NEES (ok)", *report.nees_ok);
  if (report.protection) {
    append(text, "protection %" PRId64 " levels, %" PRId64 " exceeded; median %.3f m, max %.3f m\n",
           report.protection->count, report.protection->exceeded, report.protection->level.median,
           report.protection->level.max);
  }
  if (report.relations) append_relations(text, *report.relations);
  return text;
}

}  // namespace adit
