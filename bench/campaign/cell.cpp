#include "cell.hpp"

#include <fmt/core.h>

namespace adit {
namespace {

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace

std::uint64_t seed_of(const Cell& cell, std::uint64_t base, std::int64_t drive) {
  return hash_of(fmt::format("{} {} {}", cell.name, base, drive));
}

std::string text_of(const Cell& cell) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", cell.name, static_cast<int>(cell.mine),
                     static_cast<int>(cell.plan), cell.bend_m, cell.stated_m, cell.scanner,
                     static_cast<int>(cell.clutter), static_cast<int>(cell.wheels),
                     static_cast<int>(cell.fault), static_cast<int>(cell.start),
                     static_cast<int>(cell.task));
}

}  // namespace adit
