#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "adit/geometry/result.hpp"

namespace adit {

/// A JSON value whose objects keep the order of their keys.
///
/// Built in place: `report["position"]["mean"] = 0.1;`, `poses.push_back(pose);`. Numbers that are
/// not finite become `null`.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;
  using Value =
      std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, Array, Object>;

  Json() = default;
  Json(std::nullptr_t) {}
  Json(bool value) : value_(value) {}
  Json(int value) : value_(std::int64_t{value}) {}
  Json(long value) : value_(std::int64_t{value}) {}
  Json(long long value) : value_(std::int64_t{value}) {}
  Json(std::size_t value) : value_(static_cast<std::int64_t>(value)) {}
  Json(double value);
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(std::string value) : value_(std::move(value)) {}

  /// An empty array `[]`, an empty object `{}`.
  static Json array();
  static Json object();

  /// The member of that name, made if it is not there; what was no object becomes one.
  Json& operator[](std::string_view key);

  /// The member of that name, or null.
  const Json* find(std::string_view key) const;

  /// Appends to an array; what was no array becomes one.
  void push_back(Json value);

  const Value& value() const { return value_; }

  /// The text on one line, or indented by two blanks a level; bytes that are not UTF-8 are
  /// replaced.
  std::string to_text(bool indented = true) const;

 private:
  explicit Json(Array value) : value_(std::move(value)) {}
  explicit Json(Object value) : value_(std::move(value)) {}

  Value value_ = nullptr;
};

/// Reads JSON text; `file` is the name in errors, which say where in the text.
Result<Json> parse_json(std::string_view text, const std::string& file = {});

/// Writes indented JSON and a line end, whole or not at all.
Result<void> write_json(const Json& value, const std::string& path);

}  // namespace adit
