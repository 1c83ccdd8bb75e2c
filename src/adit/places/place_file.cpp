#include "adit/places/place_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <istream>
#include <ostream>
#include <type_traits>
#include <utility>

namespace adit {
namespace {

static_assert(std::endian::native == std::endian::little, "indices are written as they lie");

constexpr std::uint64_t kMagic = 0x3258444954494441u;  // "ADITIDX2"

/// FNV-1a (Fowler, Noll, Vo), of eight bytes at a time.
class Hash {
 public:
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001B3u;
    value_ ^= value_ >> 29;
  }
  template <class Value>
  void add_all(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    std::size_t left = values.size() * sizeof(Value);
    for (; left > 0; bytes += std::min(left, sizeof(std::uint64_t)),
                     left -= std::min(left, sizeof(std::uint64_t))) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, std::min(left, sizeof word));
      add(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325u;
};

/// Of what an index holds, so that a damaged file is seen.
std::uint64_t hash_of(const PlaceArrays& arrays) {
  Hash hash;
  hash.add(arrays.origin_x);
  hash.add(arrays.origin_y);
  hash.add(arrays.pitch_m);
  hash.add_all(arrays.cells);
  hash.add_all(arrays.codes);
  return hash.value();
}

template <class Value>
void put(std::ostream& out, const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
bool get(std::istream& in, Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return static_cast<bool>(in.read(reinterpret_cast<char*>(&value), sizeof value));
}

template <class Value>
void put_all(std::ostream& out, const std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  put(out, static_cast<std::uint64_t>(values.size()));
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

/// In pieces, so that a damaged count runs into the end of the file, not out of memory.
template <class Value>
bool get_all(std::istream& in, std::vector<Value>& values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 16;
  std::uint64_t left = 0;
  if (!get(in, left)) return false;
  values.clear();
  while (left > 0) {
    const auto now = static_cast<std::size_t>(std::min(left, kPiece));
    const std::size_t had = values.size();
    values.resize(had + now);
    const auto bytes = static_cast<std::streamsize>(now * sizeof(Value));
    if (!in.read(reinterpret_cast<char*>(values.data() + had), bytes)) return false;
    left -= now;
  }
  return true;
}

}  // namespace

std::uint64_t place_key(const LineMap& map, const PlaceIndexOptions& options,
                        const PlaceCoding& coding) {
  Hash hash;
  for (const Wall& wall : map.walls()) {
    for (const Vector2d& end : {wall.segment.a, wall.segment.b}) {
      hash.add(end.x());
      hash.add(end.y());
    }
  }
  PlaceIndexOptions::visit(options, [&](const char*, const auto& value, const char*) {
    hash.add(static_cast<double>(value));
  });
  PlaceCoding::visit(coding,
                     [&](const char*, const auto& value) { hash.add(static_cast<double>(value)); });
  return hash.value();
}

Result<void> write_places(const PlaceIndex& places, const LineMap& map,
                          const PlaceIndexOptions& options, std::ostream& out) {
  const PlaceArrays& arrays = places.arrays();
  put(out, kMagic);
  put(out, place_key(map, options));
  put(out, hash_of(arrays));
  put(out, arrays.origin_x);
  put(out, arrays.origin_y);
  put(out, arrays.pitch_m);
  put_all(out, arrays.cells);
  put_all(out, arrays.codes);
  if (!out.flush()) return fail("the index cannot be written");
  return {};
}

Result<std::optional<PlaceIndex>> read_places(const LineMap& map, const PlaceIndexOptions& options,
                                              std::istream& in) {
  std::uint64_t magic = 0;
  std::uint64_t hash = 0;
  if (!get(in, magic) || magic != kMagic) return fail("not an index of places");
  if (!get(in, hash)) return fail("the index is cut short");
  if (hash != place_key(map, options)) return std::optional<PlaceIndex>();
  PlaceArrays arrays;
  std::uint64_t body = 0;
  const bool whole = get(in, body) && get(in, arrays.origin_x) && get(in, arrays.origin_y) &&
                     get(in, arrays.pitch_m) && get_all(in, arrays.cells) &&
                     get_all(in, arrays.codes) && arrays.cells.size() == arrays.codes.size();
  if (!whole) return fail("the index is cut short");
  if (body != hash_of(arrays)) return fail("the index is damaged");
  return std::optional<PlaceIndex>(std::in_place, map, std::move(arrays));
}

}  // namespace adit
