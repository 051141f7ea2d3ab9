// Builds small glTF files for the tests: JSON that a test may spoil at will, and one buffer of binary data.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace irradia::test {

using Json = nlohmann::json;

// A folder of this process' own, removed at the end of the test.
class TempFolder {
public:
    TempFolder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("irradia-scene-" + std::to_string(getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

class GltfBuilder {
public:
    Json json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
        "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "materials": []})");
    std::string buffer;

    template <typename T>
    int view(const std::vector<T>& values) {
        while (buffer.size() % 4 != 0) buffer.push_back('\0');
        const size_t offset = buffer.size(), length = values.size() * sizeof(T);
        buffer.append(reinterpret_cast<const char*>(values.data()), length);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    int accessor(int bufferView, int componentType, size_t count, const std::string& type) {
        json["accessors"].push_back(
            {{"bufferView", bufferView}, {"componentType", componentType}, {"count", count}, {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    int vec2(const std::vector<glm::vec2>& v) { return accessor(view(v), 5126, v.size(), "VEC2"); }
    int vec3(const std::vector<glm::vec3>& v) { return accessor(view(v), 5126, v.size(), "VEC3"); }
    int vec4(const std::vector<glm::vec4>& v) { return accessor(view(v), 5126, v.size(), "VEC4"); }
    int indices(const std::vector<uint16_t>& v) { return accessor(view(v), 5123, v.size(), "SCALAR"); }

    // A mesh of one primitive, and a root node that shows it. Returns the node.
    int mesh(const Json& primitive, Json node = Json::object()) {
        json["meshes"].push_back({{"primitives", {primitive}}});
        node["mesh"] = json["meshes"].size() - 1;
        return root(node);
    }

    int root(const Json& node) {
        json["nodes"].push_back(node);
        json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
        return static_cast<int>(json["nodes"].size()) - 1;
    }

    // The JSON as .glb needs it, and the file around it.
    std::string glb() const {
        Json whole = json;
        std::string data = buffer;
        if (!data.empty() && !whole.contains("buffers")) whole["buffers"] = {{{"byteLength", data.size()}}};
        std::string text = whole.dump();
        while (text.size() % 4 != 0) text.push_back(' ');
        while (data.size() % 4 != 0) data.push_back('\0');
        const size_t length = 12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size());
        std::string file = "glTF" + word(2) + word(length) + word(text.size()) + "JSON" + text;
        if (!data.empty()) file += word(data.size()) + std::string("BIN\0", 4) + data;
        return file;
    }

    static std::string word(size_t value) {
        const auto bits = static_cast<uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &bits, 4);
        return bytes;
    }
};

// A triangle in the plane z = 0, seen from +Z: its corners, positive texture coordinates (v down) and one
// mesh.
inline const std::vector<glm::vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
inline const std::vector<glm::vec2> kTriangleUv{{0, 1}, {1, 1}, {0, 0}};

} // namespace irradia::test
