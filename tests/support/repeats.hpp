#pragma once

namespace adit::test {

#if defined(__SANITIZE_ADDRESS__) || defined(ADIT_FEWER_REPEATS)
constexpr int kFewer = 4;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr int kFewer = 4;
#else
constexpr int kFewer = 1;
#endif
#else
constexpr int kFewer = 1;
#endif

/// How often to repeat what is drawn at random: under the address sanitizer, where each takes some
/// ten times as long, a fourth. Memory errors show all the same; the release build measures
/// frequencies.
constexpr int repeats(int usual) { return (usual + kFewer - 1) / kFewer; }

}  // namespace adit::test
