#include "nrc/learning/json_fields.h"

#include "engine/error.h"
#include "engine/image/read_file.h"
#include <algorithm>
#include <set>

namespace irradia {
namespace {

using Json = nlohmann::json;

// A value or a key as JSON writes it, on one line and not too long.
std::string excerpt(const Json& value) {
    std::string text = value.dump();
    if (text.size() <= 60) return text;
    size_t end = 60;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
        --end; // inside a UTF-8 sequence
    return text.substr(0, end) + "...";
}

// nlohmann writes "[json.exception.parse_error.101] parse error at line 1, column 3: what; last read:
// 'text'".
std::string reason(const Json::exception& error) {
    const std::string text = error.what();
    const size_t begin = text.find("] ");
    const size_t from = begin == std::string::npos ? 0 : begin + 2;
    return text.substr(from, text.find("; last read") - from);
}

} // namespace

Json parseJson(const std::string& text, const std::string& file) {
    if (text.size() > kMaxJsonBytes)
        fail(ExitCode::BadData, "{}: {} bytes are too many, at most {} are read", file, text.size(),
             kMaxJsonBytes);
    // The parser takes a zero byte for the end.
    if (text.find('\0') != text.npos) fail(ExitCode::BadData, "{}: not JSON: it holds a zero byte", file);
    std::vector<std::set<std::string>> keys; // of the objects that are open
    const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
        if (depth > kMaxJsonDepth) fail(ExitCode::BadData, "{}: nested deeper than {}", file, kMaxJsonDepth);
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
            fail(ExitCode::BadData, "{}: the key {} is given twice", file, excerpt(value));
        return true;
    };
    try {
        return Json::parse(text, watch);
    } catch (const Json::exception& error) {
        fail(ExitCode::BadData, "{}: not JSON: {}", file, reason(error));
    }
}

Json loadJson(const std::filesystem::path& file) {
    requireFile(file);
    if (const uint64_t bytes = std::filesystem::file_size(file); bytes > kMaxJsonBytes)
        fail(ExitCode::BadData, "{}: {} bytes are too many, at most {} are read", file.string(), bytes,
             kMaxJsonBytes);
    const std::vector<uint8_t> bytes = readFile(file);
    return parseJson({bytes.begin(), bytes.end()}, file.string());
}

bool NumberRange::contains(double value) const {
    return (bounds == LowOpen ? value > low : value >= low) &&
           (bounds == HighOpen ? value < high : value <= high);
}

std::string NumberRange::text() const {
    return fmt::format("a number from {}{:g} to {}{:g}", bounds == LowOpen ? "above " : "", low,
                       bounds == HighOpen ? "below " : "", high);
}

JsonFields::JsonFields(const Json& object, std::string file, std::string path)
    : object_(object)
    , file_(std::move(file))
    , path_(std::move(path)) {
    if (object.is_object()) return;
    const std::string where = path_.empty() ? "the file" : path_;
    fail(ExitCode::BadData, "{}: {} must be an object, not {}", file_, where, excerpt(object));
}

bool JsonFields::has(const std::string& key) const {
    return object_.contains(key);
}

double JsonFields::number(const std::string& key, const NumberRange& range) {
    const Json* value = ask(key);
    if (!value || !value->is_number() || !range.contains(value->get<double>())) refuse(key, range.text());
    return value->get<double>();
}

double JsonFields::number(const std::string& key, double fallback, const NumberRange& range) {
    return ask(key) ? number(key, range) : fallback;
}

uint32_t JsonFields::integer(const std::string& key, uint32_t low, uint32_t high) {
    const uint64_t whole = wholeNumber(key);
    if (whole < low || whole > high) refuse(key, fmt::format("a whole number from {} to {}", low, high));
    return static_cast<uint32_t>(whole);
}

uint32_t JsonFields::integer(const std::string& key, uint32_t fallback, uint32_t low, uint32_t high) {
    return ask(key) ? integer(key, low, high) : fallback;
}

uint32_t JsonFields::integer(const std::string& key, std::span<const uint32_t> allowed) {
    const uint64_t whole = wholeNumber(key);
    if (std::ranges::find(allowed, whole) == allowed.end())
        refuse(key, fmt::format("one of {}", fmt::join(allowed, ", ")));
    return static_cast<uint32_t>(whole);
}

const Json& JsonFields::section(const std::string& key) {
    const Json* value = ask(key);
    if (!value || !value->is_object()) refuse(key, "an object");
    return *value;
}

void JsonFields::numberPair(const std::string& key, double (&pair)[2], const NumberRange& range) {
    const Json* value = ask(key);
    if (!value) return;
    const auto isAllowed = [&](const Json& v) { return v.is_number() && range.contains(v.get<double>()); };
    if (!value->is_array() || value->size() != 2 || !std::ranges::all_of(*value, isAllowed))
        refuse(key, fmt::format("a list of two, each {}", range.text()));
    for (size_t i = 0; i < 2; ++i) pair[i] = (*value)[i].get<double>();
}

void JsonFields::integerPair(const std::string& key, uint32_t& low, uint32_t& high) {
    const Json* value = ask(key);
    if (!value) return;
    const auto isAllowed = [](const Json& v) {
        return v.is_number_unsigned() && v.get<uint64_t>() <= UINT32_MAX;
    };
    if (!value->is_array() || value->size() != 2 || !std::ranges::all_of(*value, isAllowed) ||
        (*value)[0].get<uint64_t>() > (*value)[1].get<uint64_t>())
        refuse(key, fmt::format("a list of two whole numbers from 0 to {}, the second not below the first",
                                UINT32_MAX));
    low = (*value)[0].get<uint32_t>();
    high = (*value)[1].get<uint32_t>();
}

void JsonFields::finish() const {
    for (const auto& [key, value] : object_.items()) {
        if (std::ranges::find(asked_, key) != asked_.end()) continue;
        fail(ExitCode::BadData, "{}: unknown key {}, there are {} here", file_, pathOf(key),
             fmt::join(asked_, ", "));
    }
}

std::string JsonFields::pathOf(const std::string& key) const {
    const std::string text = excerpt(Json(key));
    const std::string name = text == '"' + key + '"' ? key : text; // as it is, unless escaped or cut
    return path_.empty() ? name : path_ + '.' + name;
}

void JsonFields::refuse(const std::string& key, const std::string& allowed) const {
    if (!has(key)) fail(ExitCode::BadData, "{}: {} is missing, it must be {}", file_, pathOf(key), allowed);
    fail(ExitCode::BadData, "{}: {} must be {}, not {}", file_, pathOf(key), allowed, excerpt(object_[key]));
}

const Json* JsonFields::ask(const std::string& key) {
    if (std::ranges::find(asked_, key) == asked_.end()) asked_.push_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

// UINT64_MAX, which no key allows, for what is none.
uint64_t JsonFields::wholeNumber(const std::string& key) {
    const Json* value = ask(key);
    return value && value->is_number_unsigned() ? value->get<uint64_t>() : UINT64_MAX;
}

size_t JsonFields::choice(const std::string& key, std::span<const char* const> names) {
    const Json* value = ask(key);
    const auto* const text = value ? value->get_ptr<const std::string*>() : nullptr;
    const auto found = std::ranges::find_if(names, [&](const char* name) { return text && *text == name; });
    if (found == names.end()) refuse(key, fmt::format("one of {}", fmt::join(names, ", ")));
    return static_cast<size_t>(found - names.begin());
}

} // namespace irradia
