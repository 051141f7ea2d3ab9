// Which pixel and sample a path of the wave is. WAVE is a WaveParams (shared/path.h), `params` unless it is defined.
#ifndef IRRADIA_PATH_WAVE_GLSL
#define IRRADIA_PATH_WAVE_GLSL
#ifndef WAVE
#define WAVE params
#endif

uint pixelOf(uint path) { return WAVE.firstPixel + (path >> WAVE.log2Samples); }

uint sampleInWave(uint path) { return path & ((1u << WAVE.log2Samples) - 1u); }

uint sampleOf(uint path) { return WAVE.sampleIndex + sampleInWave(path); }

#endif
