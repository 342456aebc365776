#pragma once
// Functions marked CAVEA_WIDE are loops over arrays, of which the compiler makes a version for each
// of these instruction sets, chosen when the program starts. Nothing is fused (-ffp-contract=off)
// and no sum is reordered, so all give the same bits. Sanitizers start after that choice would be
// made.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
#define CAVEA_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CAVEA_WIDE
#endif
