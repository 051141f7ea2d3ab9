// The keys that encodings take: how each is read, within its limits, and written.
#include "nrc/learning/encodings/kind.h"
#include <bit>

namespace irradia {
namespace {

nlohmann::ordered_json whole(double value) {
    return static_cast<uint32_t>(value);
}

nlohmann::ordered_json number(double value) {
    return value;
}

} // namespace

EncodingKey wholeKey(const char* name, uint32_t low, uint32_t high, uint32_t standard) {
    const auto read = [=](JsonFields& fields) { return fields.integer(name, low, high); };
    return {name, static_cast<double>(standard), read, whole};
}

EncodingKey wholeKey(const char* name, std::initializer_list<uint32_t> allowed, uint32_t standard) {
    const auto read = [name, list = std::vector<uint32_t>(allowed)](JsonFields& fields) {
        return fields.integer(name, list);
    };
    return {name, static_cast<double>(standard), read, whole};
}

EncodingKey numberKey(const char* name, NumberRange range, double standard) {
    return {name, standard, [=](JsonFields& fields) { return fields.number(name, range); }, number};
}

EncodingKey optionalNumberKey(const char* name, NumberRange range, double standard) {
    const auto read = [=](JsonFields& fields) { return fields.number(name, standard, range); };
    return {name, standard, read, number};
}

EncodingKey choiceKey(const char* name, std::vector<const char*> names) {
    const auto read = [name, names](JsonFields& fields) {
        return static_cast<double>(fields.member(name) ? fields.choice(name, names) : 0);
    };
    const auto write = [names](double place) {
        return nlohmann::ordered_json(names.at(static_cast<size_t>(place)));
    };
    return {name, 0.0, read, write};
}

uint32_t floatBits(double value) {
    return std::bit_cast<uint32_t>(static_cast<float>(value));
}

} // namespace irradia
