#include "adit/io/saved_pose.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <optional>

#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A number; `null` is one that is not finite.
std::optional<double> number_in(const Json* json) {
  if (json == nullptr) return std::nullopt;
  if (std::holds_alternative<std::nullptr_t>(json->value())) return kInfinite;
  if (const auto* real = std::get_if<double>(&json->value())) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&json->value()))
    return static_cast<double>(*whole);
  return std::nullopt;
}

/// Reads the members of one object, and remembers the first that is wrong.
class Members {
 public:
  explicit Members(const Json& json) : json_(json) {}

  double finite(const char* key) {
    const std::optional<double> value = number_in(json_.find(key));
    if (!value || !std::isfinite(*value)) expect(key, "a finite number");
    return value.value_or(0.0);
  }

  std::string word(const char* key) const {
    const Json* member = json_.find(key);
    const auto* text = member ? std::get_if<std::string>(&member->value()) : nullptr;
    return text ? *text : std::string();
  }

  Status status(const char* key) {
    const std::string found = word(key);
    for (const Status status : {Status::ok, Status::degraded, Status::ambiguous, Status::lost}) {
      if (found == to_string(status)) return status;
    }
    expect(key, "ok, degraded, ambiguous or lost");
    return Status::lost;
  }

  Matrix3d covariance(const char* key) {
    const Json* member = json_.find(key);
    const auto* list = member ? std::get_if<Json::Array>(&member->value()) : nullptr;
    std::array<double, 6> c{};
    bool fits = list != nullptr && list->size() == c.size();
    for (std::size_t i = 0; fits && i < c.size(); ++i) {
      const std::optional<double> value = number_in(&(*list)[i]);
      fits = value.has_value();
      c[i] = value.value_or(0.0);
    }
    Matrix3d out;
    out << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    if (!fits || !is_covariance(out)) expect(key, "the covariance's xx, xy, xt, yy, yt, tt");
    return out;
  }

  const std::optional<std::string>& wrong() const { return wrong_; }

 private:
  void expect(const char* key, const std::string& what) {
    if (!wrong_) wrong_ = "expected " + in_quotes(key) + ": " + what;
  }

  /// One with an unknown variance says nothing; any other must have no direction below zero, but
  /// for rounding.
  static bool is_covariance(const Matrix3d& covariance) {
    if (!covariance.allFinite()) return true;
    constexpr double kRounding = 1e-9;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
    return eigen.eigenvalues().minCoeff() >= -kRounding * covariance.diagonal().cwiseAbs().sum();
  }

  const Json& json_;
  std::optional<std::string> wrong_;
};

}  // namespace

std::array<double, 6> upper_triangle(const Matrix3d& covariance) {
  return {covariance(0, 0), covariance(0, 1), covariance(0, 2),
          covariance(1, 1), covariance(1, 2), covariance(2, 2)};
}

Result<void> write_saved_pose(const SavedPose& saved, const std::string& path) {
  Json json = Json::object();
  json["stamp"] = saved.stamp;
  json["x"] = saved.pose.x;
  json["y"] = saved.pose.y;
  json["theta"] = saved.pose.theta;
  json["cov"] = Json::array();
  for (const double value : upper_triangle(saved.covariance)) json["cov"].push_back(value);
  json["status"] = to_string(saved.status);
  if (!saved.level.empty()) json["level"] = saved.level;
  return write_json(json, path);
}

Result<SavedPose> parse_saved_pose(std::string_view text, const std::string& file) {
  if (const auto checked = check_text(text, file); !checked) return tl::unexpected(checked.error());
  const Result<Json> json = parse_json(text, file);
  if (!json) return tl::unexpected(json.error());
  if (!std::holds_alternative<Json::Object>(json->value())) {
    return fail("expected a saved pose: {\"stamp\", \"x\", \"y\", \"theta\", \"cov\", \"status\"}",
                file);
  }
  Members members(*json);
  SavedPose saved;
  saved.stamp = members.finite("stamp");
  saved.pose.x = members.finite("x");
  saved.pose.y = members.finite("y");
  saved.pose.theta = wrap_angle(members.finite("theta"));
  saved.covariance = members.covariance("cov");
  saved.status = members.status("status");
  saved.level = members.word("level");
  if (members.wrong()) return fail(*members.wrong(), file);
  return saved;
}

Result<SavedPose> read_saved_pose(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_saved_pose(*text, path);
}

}  // namespace adit
