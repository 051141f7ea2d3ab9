#include "engine/scene/gltf/lights.h"
#include "engine/scene/gltf/model_check.h"
#include "engine/scene/gltf/values.h"
#include <algorithm>
#include <cmath>

namespace irradia::gltf {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

class LightCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        const bool isGood = each(model_.lights, [&](size_t i) { checkLight(i); });
        return each(model_.nodes, [&](size_t i) { checkNode(i); }) && isGood;
    }

private:
    void checkLight(size_t index) const {
        const tinygltf::Light& light = model_.lights[index];
        const Thing owner{thing("light", "lights", index, light.name).name,
                          fmt::format("/extensions/{}/lights/{}", kExtension, index)};
        if (light.type != "point" && light.type != "spot" && light.type != "directional")
            source_.refuse(owner.at("type"), "VALUE_NOT_IN_LIST", "type '{}', there are {}", light.type,
                           "point, spot, directional");
        if (!(light.intensity >= 0))
            source_.refuse(owner.at("intensity"), "VALUE_NOT_IN_RANGE", "intensity {} is below 0",
                           light.intensity);
        if (const size_t length = light.color.size(); length != 0 && length != 3)
            source_.refuse(owner.at("color"), "ARRAY_LENGTH_NOT_IN_LIST", "color of {} numbers, not 3",
                           length);
        for (const double channel : light.color)
            if (!(channel >= 0))
                source_.refuse(owner.at("color"), "VALUE_NOT_IN_RANGE", "color {} is below 0", channel);
        if (hasRange(index) && !(light.range > 0))
            source_.refuse(owner.at("range"), "VALUE_NOT_IN_RANGE", "range {} is not above 0", light.range);
        if (light.type == "spot") checkAngles(owner.at("spot"), light.spot);
    }

    // tinygltf takes 0 for an absent range.
    bool hasRange(size_t index) const {
        const Extension extension = findExtension(model_.extensions, kExtension);
        if (!extension || member(*extension, "lights").ArrayLen() <= index) return false;
        return member(extension->Get("lights").Get(static_cast<int>(index)), "range").IsNumber();
    }

    void checkAngles(const Thing& owner, const tinygltf::SpotLight& spot) const {
        constexpr double kMost = 1.57079633 * (1 + 1e-6); // a right angle, as exporters round it
        if (!(spot.innerConeAngle >= 0 && spot.innerConeAngle <= kMost))
            source_.refuse(owner.at("innerConeAngle"), "VALUE_NOT_IN_RANGE",
                           "innerConeAngle {} is outside 0 to pi/2", spot.innerConeAngle);
        if (!(spot.outerConeAngle > 0 && spot.outerConeAngle <= kMost))
            source_.refuse(owner.at("outerConeAngle"), "VALUE_NOT_IN_RANGE",
                           "outerConeAngle {} is not above 0 and up to pi/2", spot.outerConeAngle);
        if (spot.innerConeAngle > spot.outerConeAngle)
            source_.refuse(owner, kAngles, "innerConeAngle {} beyond outerConeAngle {}", spot.innerConeAngle,
                           spot.outerConeAngle);
        if (spot.innerConeAngle == spot.outerConeAngle) // a hard edge, as some exporters write it
            source_.warn(owner, kAngles, "innerConeAngle and outerConeAngle are both {}",
                         spot.outerConeAngle);
    }

    void checkNode(size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        const Thing owner = thing("node", "nodes", index, node.name);
        const Extension extension = findExtension(node.extensions, kExtension);
        if (extension && extension->Has("light"))
            checkIndex(owner.at("extensions").at(kExtension).at("light"), "light", lightOf(node),
                       model_.lights.size(), Need::Required);
    }

    static constexpr const char* kAngles = "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES";
};

} // namespace

bool checkLights(const SourceFile& source, const tinygltf::Model& model) {
    return LightCheck(source, model).checkAll();
}

} // namespace irradia::gltf
