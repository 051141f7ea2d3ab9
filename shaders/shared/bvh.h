// The bounding volume hierarchy as items of 3 quads: a 4-wide tree in which nodes and triangles have one size, so
// that a traversal step is the same three loads whatever it meets. A node's children are consecutive items; a leaf
// is one triangle.
//
// Node, child boxes quantised to 8 bits on a grid (Ylitie et al. 2017, "Efficient Incoherent Ray Traversal on GPUs
// Through Compressed Wide BVHs"): plane = origin + q * 2^(e - 127), rounded outwards.
//   0: origin xyz of the grid (floats), byte a = e of axis a, top byte 0
//   1: lower x, lower y, lower z, upper x     each a word of 4 bytes, byte k = q of child k
//   2: upper y, upper z, item of child 0 << kGroupBits, bit k = child k is there
//
// Triangle:
//   0: p0 xyz, primitive | kTriangleItem
//   1: e1 xyz, e2 x
//   2: e2 yz, margin (8 * 2^-24 times the longer edge), 1 if it may let light straight on through, else 0
//
// A group, what a traversal keeps on its stack: the item of a node's child 0 << kGroupBits and, nearest first, the
// numbers of the children still to be visited, kChildBits each; kNoChild where there are no more.
#ifndef IRRADIA_SHARED_BVH_H
#define IRRADIA_SHARED_BVH_H
#include "shared/types.h"
SHARED_BEGIN

SHARED_CONST uint kItemQuads = 3u;
SHARED_CONST uint kBvhWidth = 4u;
SHARED_CONST uint kTriangleItem = 0x80000000u;
SHARED_CONST uint kPrimitiveMask = 0x7fffffffu;

SHARED_CONST uint kChildBits = 3u;
SHARED_CONST uint kChildMask = 7u;
SHARED_CONST uint kNoChild = 7u;
SHARED_CONST uint kGroupBits = 9u;
SHARED_CONST uint kGroupMask = 511u;
SHARED_CONST uint kLastChild = 7u << 6; // kNoChild in the last place: what a group is filled up with when its first child is taken off

// Groups on a ray's stack. The builder keeps what its tree can need within it.
SHARED_CONST uint kTraversalStack = 64u;

SHARED_END
#endif
