// Which pixel and sample a path of the wave is. `params` is a WaveParams (shared/path.h).
#ifndef IRRADIA_PATH_WAVE_GLSL
#define IRRADIA_PATH_WAVE_GLSL

uint pixelOf(uint path) { return params.firstPixel + (path >> params.log2Samples); }

uint sampleInWave(uint path) { return path & ((1u << params.log2Samples) - 1u); }

uint sampleOf(uint path) { return params.sampleIndex + sampleInWave(path); }

#endif
