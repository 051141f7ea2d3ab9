#include "engine/image/exr_attribute.h"

#include <ImfBoxAttribute.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfLineOrderAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <ImfVecAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace irradia {
namespace {

std::string text(int value) {
    return fmt::format("{}", value);
}
std::string text(float value) {
    return fmt::format("{}", value);
}
std::string text(double value) {
    return fmt::format("{}", value);
}
std::string text(const std::string& value) {
    return value;
}
std::string text(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, ", "));
}
std::string text(const std::vector<float>& values) {
    return fmt::format("{}", fmt::join(values, " "));
}
template <typename T>
std::string text(const Imath::Vec2<T>& v) {
    return fmt::format("{} {}", v.x, v.y);
}
template <typename T>
std::string text(const Imath::Vec3<T>& v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}
template <typename V>
std::string text(const Imath::Box<V>& box) {
    return fmt::format("{}, {}", text(box.min), text(box.max));
}
template <typename T>
std::string text(const Imath::Matrix33<T>& m) {
    return fmt::format("{}, {}, {}", fmt::join(m[0], m[0] + 3, " "), fmt::join(m[1], m[1] + 3, " "),
                       fmt::join(m[2], m[2] + 3, " "));
}
template <typename T>
std::string text(const Imath::Matrix44<T>& m) {
    return fmt::format("{}, {}, {}, {}", fmt::join(m[0], m[0] + 4, " "), fmt::join(m[1], m[1] + 4, " "),
                       fmt::join(m[2], m[2] + 4, " "), fmt::join(m[3], m[3] + 4, " "));
}
std::string text(const Imf::Chromaticities& c) {
    return fmt::format("red {}, green {}, blue {}, white {}", text(c.red), text(c.green), text(c.blue),
                       text(c.white));
}
std::string text(const Imf::Rational& value) {
    return fmt::format("{}/{}", value.n, value.d);
}
std::string text(const Imf::TimeCode& t) {
    return fmt::format("{:02}:{:02}:{:02}:{:02}", t.hours(), t.minutes(), t.seconds(), t.frame());
}
std::string text(const Imf::TileDescription& tiles) {
    constexpr const char* kLevels[] = {"one level", "mipmaps", "ripmaps"};
    return fmt::format("{} x {}, {}", tiles.xSize, tiles.ySize, tiles.mode < 3 ? kLevels[tiles.mode] : "?");
}
std::string text(Imf::LineOrder order) {
    return order == Imf::INCREASING_Y   ? "increasing y"
           : order == Imf::DECREASING_Y ? "decreasing y"
                                        : "random y";
}
std::string text(Imf::Envmap map) {
    return map == Imf::ENVMAP_LATLONG ? "latitude and longitude" : "cube";
}

template <typename T>
bool readAs(const Imf::Attribute& attribute, std::string& result) {
    const auto* typed = dynamic_cast<const Imf::TypedAttribute<T>*>(&attribute);
    if (typed) result = text(typed->value());
    return typed != nullptr;
}

template <typename... Types>
bool readAsAny(const Imf::Attribute& attribute, std::string& result) {
    return (readAs<Types>(attribute, result) || ...);
}

} // namespace

std::string textOf(const Imf::Attribute& attribute) {
    std::string result;
    const bool isRead =
        readAsAny<std::string, int, float, double, Imath::V2i, Imath::V2f, Imath::V2d, Imath::V3i, Imath::V3f,
                  Imath::V3d, Imath::Box2i, Imath::Box2f, Imath::M33f, Imath::M33d, Imath::M44f, Imath::M44d,
                  Imf::Chromaticities, Imf::Rational, Imf::TimeCode, Imf::TileDescription, Imf::LineOrder,
                  Imf::Envmap, Imf::StringVector, Imf::FloatVector>(attribute, result);
    return isRead ? result : fmt::format("({})", attribute.typeName());
}

std::string nameOfCompression(Imf::Compression compression) {
    constexpr const char* kNames[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                      "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    const auto index = static_cast<size_t>(compression);
    return index < std::size(kNames) ? kNames[index] : fmt::format("number {}", index);
}

} // namespace irradia
