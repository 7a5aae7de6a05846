// Loops that are compiled for any machine, and again for those with wider vectors.
#pragma once

// The same operations on each element, so the same bits: -ffp-contract=off, nothing is summed
// across elements. Sanitizers cannot be up before the choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__OPTIMIZE__) && \
    !DIBHR_SANITIZED && !defined(__clang__)
#define DIBHR_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define DIBHR_VECTOR_CLONES
#endif
