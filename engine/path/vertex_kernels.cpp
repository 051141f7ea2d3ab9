#include "engine/path/vertex_kernels.h"

#include "kernels/path.h"

namespace irradia {

VertexKernels plainVertexKernels() {
    return {&kernels::handle_escaped_rays, &kernels::handle_emissive_hits, &kernels::scatter,
            &kernels::add_direct_light, &kernels::add_filtered_light};
}

VertexKernels cachedVertexKernels() {
    return {
        &kernels::handle_escaped_rays_cached, &kernels::handle_emissive_hits_cached, &kernels::scatter_cached,
        &kernels::add_direct_light_cached,    &kernels::add_filtered_light_cached,   true};
}

} // namespace irradia
