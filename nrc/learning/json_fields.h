// JSON read strictly: each member of an object is asked for with what is allowed, and one that was not asked
// for is refused. Every error is one sentence with the file, the key's path and what may stand there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace irradia {

constexpr uint64_t kMaxJsonBytes = 1u << 16; // a model needs 2,000; nlohmann takes quadratic time for lists
constexpr int kMaxJsonDepth = 16;            // a model needs 4

// A name of an enumeration's value.
template <typename Enum>
struct EnumName {
    Enum value;
    const char* name;
};

template <typename Enum, size_t N>
const char* nameOf(const EnumName<Enum> (&names)[N], Enum value) {
    for (const EnumName<Enum>& entry : names)
        if (entry.value == value) return entry.name;
    return "";
}

// Throws Error(BadData) for broken JSON, a key given twice, or more than the limits above.
nlohmann::json parseJson(const std::string& text, const std::string& file);
// The same of a file. Throws Error: NotFound, Io, and BadData naming it.
nlohmann::json loadJson(const std::filesystem::path& file);

// What a number must lie in.
struct NumberRange {
    double low;
    double high;
    enum Bounds { Closed, LowOpen, HighOpen } bounds = Closed;

    bool contains(double value) const;
    std::string text() const;
};

class JsonFields {
public:
    // `path` is where `object` stands, "optimizer.nested"; empty for the file itself.
    JsonFields(const nlohmann::json& object, std::string file, std::string path);

    bool has(const std::string& key) const;
    // Each refuses a key that is missing, unless there is a `fallback` to return.
    double number(const std::string& key, const NumberRange& range);
    uint32_t integer(const std::string& key, uint32_t low, uint32_t high);
    uint32_t integer(const std::string& key, std::span<const uint32_t> allowed);
    uint32_t integer(const std::string& key, std::initializer_list<uint32_t> allowed) {
        return integer(key, std::span(allowed.begin(), allowed.size()));
    }
    size_t choice(const std::string& key, std::span<const char* const> names); // the place of the one chosen
    template <typename Enum, size_t N>
    Enum choice(const std::string& key, const EnumName<Enum> (&names)[N]) {
        return names[choice(key, textsOf(names))].value;
    }
    const nlohmann::json& section(const std::string& key); // an object

    double number(const std::string& key, double fallback, const NumberRange& range);
    uint32_t integer(const std::string& key, uint32_t fallback, uint32_t low, uint32_t high);
    void numberPair(const std::string& key, double (&pair)[2], const NumberRange& range);
    void integerPair(const std::string& key, uint32_t& low, uint32_t& high); // low <= high

    template <typename Enum, size_t N>
    Enum choice(const std::string& key, Enum fallback, const EnumName<Enum> (&names)[N]) {
        return ask(key) ? names[choice(key, textsOf(names))].value : fallback;
    }

    // Null where the key is missing.
    const nlohmann::json* member(const std::string& key) { return ask(key); }

    void finish() const; // refuses the members nobody asked for
    std::string pathOf(const std::string& key) const;
    const std::string& file() const { return file_; }
    [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;

private:
    template <typename Enum, size_t N>
    static std::vector<const char*> textsOf(const EnumName<Enum> (&names)[N]) {
        std::vector<const char*> texts;
        for (const EnumName<Enum>& entry : names) texts.push_back(entry.name);
        return texts;
    }

    const nlohmann::json* ask(const std::string& key);
    uint64_t wholeNumber(const std::string& key);

    const nlohmann::json& object_;
    std::string file_;
    std::string path_;
    std::vector<std::string> asked_;
};

} // namespace irradia
