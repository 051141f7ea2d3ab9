// Keeps lavapipe's compiled shaders of different vector widths apart on disk.
#pragma once

namespace irradia {

// Mesa (25.0 at least) looks cached code up without the vector width it was made for: once the same cache has
// served LP_NATIVE_VECTOR_WIDTH = 512, kernels lose lanes at 256 without a word. So where that variable is
// set, the cache moves to a folder of its own. To be called before the driver is loaded; later calls do
// nothing.
void separateShaderCaches();

} // namespace irradia
