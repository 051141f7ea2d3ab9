// What lavapipe reads from the environment when its driver is loaded: to be set before the first Instance.
#pragma once

namespace irradia {

// For programs, first of all: where LP_NATIVE_VECTOR_WIDTH is not set and the processor has AVX-512, vectors
// of 512 bits, so subgroups of 16 lanes. By itself lavapipe takes 256 there. Changes the environment, so no
// other thread may run yet.
void preferWideVectors();

// Keeps compiled shaders of different vector widths apart on disk. Mesa (25.0 at least) looks cached code up
// without the width it was made for: once the same cache has served LP_NATIVE_VECTOR_WIDTH = 512, kernels
// lose lanes at 256 without a word. So where that variable is set, the cache moves to a folder of its own.
// Instance calls it; later calls do nothing.
void separateShaderCaches();

} // namespace irradia
