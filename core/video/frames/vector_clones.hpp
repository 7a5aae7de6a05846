// DIBHR_VECTOR_CLONES: compiles a loop for any machine, and again for machines with wider vectors.
#pragma once

// All clones give the same bits: the same operations on each element, -ffp-contract=off, no sums
// across elements. Not with sanitizers: they start later than the clone is chosen.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__OPTIMIZE__) && \
    !DIBHR_SANITIZED && !defined(__clang__)
#define DIBHR_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define DIBHR_VECTOR_CLONES
#endif
