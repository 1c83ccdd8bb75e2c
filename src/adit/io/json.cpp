#include "adit/io/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "adit/io/atomic_file.hpp"

namespace adit {
namespace {

using Library = nlohmann::ordered_json;
constexpr int kDeepest = 200;  // levels that are read: recursion must not eat the stack

Library to_library(const Json& json) {
  return std::visit(
      [](const auto& value) -> Library {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Json::Array>) {
          Library out = Library::array();
          for (const Json& item : value) out.push_back(to_library(item));
          return out;
        } else if constexpr (std::is_same_v<T, Json::Object>) {
          Library out = Library::object();
          for (const auto& [key, item] : value) out[key] = to_library(item);
          return out;
        } else {
          return Library(value);
        }
      },
      json.value());
}

Json from_library(const Library& in) {
  switch (in.type()) {
    case Library::value_t::boolean:
      return in.get<bool>();
    case Library::value_t::number_integer:
      return in.get<std::int64_t>();
    case Library::value_t::number_unsigned:
      if (in.get<std::uint64_t>() <= INT64_MAX) return in.get<std::int64_t>();
      return in.get<double>();
    case Library::value_t::number_float:
      return in.get<double>();
    case Library::value_t::string:
      return in.get<std::string>();
    case Library::value_t::array: {
      Json out = Json::array();
      for (const Library& item : in) out.push_back(from_library(item));
      return out;
    }
    case Library::value_t::object: {
      Json out = Json::object();
      for (const auto& [key, item] : in.items()) out[key] = from_library(item);
      return out;
    }
    default:
      return nullptr;
  }
}

bool too_deep(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) return true;
  }
  return false;
}

}  // namespace

Json::Json(double value) {
  if (std::isfinite(value)) value_ = value;
}

Json Json::array() { return Json(Array{}); }

Json Json::object() { return Json(Object{}); }

Json& Json::operator[](std::string_view key) {
  if (!std::holds_alternative<Object>(value_)) value_ = Object{};
  Object& members = std::get<Object>(value_);
  for (auto& [name, member] : members)
    if (name == key) return member;
  return members.emplace_back(std::string(key), Json()).second;
}

const Json* Json::find(std::string_view key) const {
  const Object* members = std::get_if<Object>(&value_);
  if (members == nullptr) return nullptr;
  for (const auto& [name, member] : *members)
    if (name == key) return &member;
  return nullptr;
}

void Json::push_back(Json value) {
  if (!std::holds_alternative<Array>(value_)) value_ = Array{};
  std::get<Array>(value_).push_back(std::move(value));
}

std::string Json::to_text(bool indented) const {
  return to_library(*this).dump(indented ? 2 : -1, ' ', false, Library::error_handler_t::replace);
}

Result<Json> parse_json(std::string_view text, const std::string& file) {
  if (too_deep(text)) return fail("more than 200 levels of nesting", file);
  try {
    return from_library(Library::parse(text));
  } catch (const Library::exception& error) {
    return fail(error.what(), file);
  }
}

Result<void> write_json(const Json& value, const std::string& path) {
  return write_file(path, value.to_text() + "\n");
}

}  // namespace adit
