#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace adit {

/// A square matrix of bits in rows of 64-bit words; the rows of a graph's neighbours.
class BitMatrix {
 public:
  /// `size` rows and columns, all clear. Allocates only to grow.
  void reset(std::size_t size) {
    size_ = size;
    words_ = (size + 63) / 64;
    bits_.assign(size_ * words_, 0);
  }

  std::size_t size() const { return size_; }
  std::size_t words() const { return words_; }
  const std::uint64_t* row(std::size_t i) const { return bits_.data() + i * words_; }
  bool test(std::size_t i, std::size_t j) const { return (row(i)[j / 64] >> (j % 64)) & 1u; }
  void set(std::size_t i, std::size_t j) {
    bits_[i * words_ + j / 64] |= std::uint64_t{1} << (j % 64);
  }
  /// Sets both (i, j) and (j, i).
  void set_both(std::size_t i, std::size_t j) {
    set(i, j);
    set(j, i);
  }

 private:
  std::size_t size_ = 0;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

/// Calls `visit(index)` for every set bit, ascending.
template <class Visit>
void for_each_bit(const std::uint64_t* words, std::size_t count, Visit&& visit) {
  for (std::size_t w = 0; w < count; ++w) {
    for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
      visit(w * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

}  // namespace adit
