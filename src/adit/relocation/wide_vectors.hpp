#pragma once

/// Before a function whose loops exist for machines with wider vectors as well, where the linker
/// can choose. Such loops must give the same either way: they add up integers, or floating-point
/// numbers lane by lane.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define ADIT_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ADIT_WIDE
#endif
