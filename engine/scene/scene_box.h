// The part of a scene that a radiance cache covers, and that a camera frames where the scene has none.
#pragma once

#include "engine/scene/scene.h"

namespace irradia {

// The bounds of the scene without its strays: what lies far from nearly all of its area.
//   - The core is the box that leaves out, at each of its six faces, the outermost hundredth of the area.
//   - The core grown on all sides by 8 times its longest edge is as far as the box may reach; triangles
//   beyond
//     are strays, and those that stick out are cut there.
// Where nothing lies beyond, the box is sceneBounds(scene), to the bit. Weighing by area keeps a stadium
// about a teapot, however few its triangles, and a ground that outweighs what stands on it: a scene of some
// metres upon a ground of many kilometres has a box of many kilometres.
Bounds sceneBox(const Scene& scene);

} // namespace irradia
