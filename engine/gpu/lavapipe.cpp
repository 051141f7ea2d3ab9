#include "engine/gpu/lavapipe.h"
#include <cstdlib>
#include <filesystem>
#include <string>

namespace irradia {
namespace {

constexpr const char* kWidthVariable = "LP_NATIVE_VECTOR_WIDTH";

bool processorHas512Bits() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

// Where Mesa keeps its cache; empty if it has no place.
std::filesystem::path cacheFolder() {
    if (const char* own = std::getenv("MESA_SHADER_CACHE_DIR")) return own;
    if (const char* user = std::getenv("XDG_CACHE_HOME")) return user;
    if (const char* home = std::getenv("HOME")) return std::filesystem::path(home) / ".cache";
    return {};
}

void moveCache(const std::string& width) {
    std::filesystem::path folder = cacheFolder();
    std::error_code failed;
    if (!folder.empty()) {
        folder /= "irradia-lavapipe-" + width;
        std::filesystem::create_directories(folder, failed);
    }
    if (folder.empty() || failed)
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    else
        setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 1);
}

} // namespace

void preferWideVectors() {
    if (processorHas512Bits()) setenv(kWidthVariable, "512", 0); // 0: what is set stays
}

void separateShaderCaches() {
    static const bool done = [] {
        if (const char* width = std::getenv(kWidthVariable)) moveCache(width);
        return true;
    }();
    static_cast<void>(done);
}

} // namespace irradia
