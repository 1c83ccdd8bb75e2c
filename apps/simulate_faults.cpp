#include "simulate_faults.hpp"

#include <fmt/core.h>

#include <cmath>
#include <set>
#include <type_traits>

#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr double kMostCount = 1000.0;

/// Whether the number suits the field, which then has it.
template <class Value>
bool set(double number, Value& value) {
  if (!std::isfinite(number)) return false;
  if constexpr (!std::is_same_v<Value, double>) {
    const double most = std::is_same_v<Value, bool> ? 1.0 : kMostCount;
    if (number != std::floor(number) || number < 0.0 || number > most) return false;
  }
  value = static_cast<Value>(number);
  return true;
}

/// Whether the text was given to the field of that name.
struct Setter {
  const std::string& name;
  const std::string& text;
  bool is_known = false;
  bool is_set = false;

  template <class Value>
  void operator()(const char* field, Value& value, const char*) {
    if (name != field) return;
    is_known = true;
    const auto number = to_number(text);
    is_set = number && set(*number, value);
  }
};

}  // namespace

Result<void> set_faults(const std::vector<std::string>& pairs, OdometryFaults& odometry,
                        ScannerFaults& scanner) {
  std::set<std::string> given;
  for (const std::string& pair : pairs) {
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string name = pair.substr(0, equals);
    const std::string text = equals < pair.size() ? pair.substr(equals + 1) : "";
    Setter setter{name, text};
    OdometryFaults::visit(odometry, setter);
    ScannerFaults::visit(scanner, setter);
    if (!setter.is_known) return fail("--fault: no key '" + name + "'; --help lists them");
    if (!setter.is_set) return fail(fmt::format("--fault: '{}' is no number for {}", text, name));
    if (!given.insert(name).second) return fail("--fault: '" + name + "' is given twice");
  }
  return {};
}

std::string fault_help() {
  std::string help = "what fails, as key=number,…";
  const auto list = [&](const char* name, const auto& value, const char* what) {
    help += fmt::format("\n{}: {} (default: {:g})", name, what, static_cast<double>(value));
  };
  const OdometryFaults odometry;
  OdometryFaults::visit(odometry, list);
  const ScannerFaults scanner;
  ScannerFaults::visit(scanner, list);
  return help;
}

}  // namespace adit
