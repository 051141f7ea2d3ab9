#include "tests/support/light_chances.h"

namespace irradia::test {

std::vector<double> lightChances(const LightTree& tree, const reference::Receiver& receiver) {
    std::vector<reference::LightNode> nodes;
    for (const LightTreeNode& n : tree.nodes)
        nodes.push_back(
            {n.center, n.radius, n.cone.axis, n.cone.spread, n.cone.reach, n.power, n.child, n.isLeaf});
    return reference::lightChances(nodes, receiver);
}

} // namespace irradia::test
