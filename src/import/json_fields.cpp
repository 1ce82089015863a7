#include "import/json_fields.h"

#include "base/error.h"
#include "import/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

using Json = nlohmann::json;

std::string listed(std::initializer_list<std::string_view> keys) {
    std::string list;
    for (const std::string_view key : keys) list += (list.empty() ? "" : ", ") + std::string(key);
    return list;
}

}  // namespace

double read_number(const Json& value, double low, double high, const std::string& where) {
    if (!value.is_number()) throw Error(where, "is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) throw Error(where, "is not finite");
    if (number < low || number > high)
        throw Error(where, fmt::format("{:g} is not within {:g} and {:g}", number, low, high));
    return number;
}

JsonFields::JsonFields(const Json& object, std::string place,
                       std::initializer_list<std::string_view> keys)
    : object_(object), place_(std::move(place)) {
    if (!object.is_object()) throw Error(place_, "is not an object");
    for (const auto& member : object.items())
        if (std::ranges::find(keys, std::string_view(member.key())) == keys.end())
            throw Error(where(printable(member.key())), "there is no such key here",
                        "there are " + listed(keys));
}

std::string JsonFields::where(std::string_view key) const {
    return place_ + (place_.ends_with(' ') ? "" : ".") + std::string(key);
}

std::optional<float> JsonFields::number(const char* key, double low, double high) const {
    if (!has(key)) return std::nullopt;
    return static_cast<float>(read_number(at(key), low, high, where(key)));
}

std::optional<bool> JsonFields::flag(const char* key) const {
    if (!has(key)) return std::nullopt;
    if (!at(key).is_boolean()) throw Error(where(key), "is not true or false");
    return at(key).get<bool>();
}

std::optional<std::string> JsonFields::text(const char* key) const {
    if (!has(key)) return std::nullopt;
    if (!at(key).is_string()) throw Error(where(key), "is not a string");
    return at(key).get<std::string>();
}

std::optional<std::vector<float>> JsonFields::numbers(const char* key, std::size_t count,
                                                      double low, double high) const {
    if (!has(key)) return std::nullopt;
    const Json& list = at(key);
    if (!list.is_array() || list.size() != count)
        throw Error(where(key), fmt::format("is not a list of {} numbers", count));
    std::vector<float> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(static_cast<float>(
            read_number(list[i], low, high, fmt::format("{}[{}]", where(key), i))));
    return result;
}

std::optional<Vec3> JsonFields::vector(const char* key, double most) const {
    const auto found = numbers(key, 3, -most, most);
    if (!found) return std::nullopt;
    return Vec3((*found)[0], (*found)[1], (*found)[2]);
}

std::optional<Vec3> JsonFields::direction(const char* key) const {
    const auto found = vector(key, 1e9);
    if (found && !(glm::length(*found) > 1e-9f)) throw Error(where(key), "has no direction");
    return found;
}

std::optional<Rgb> JsonFields::color(const char* key, double most) const {
    const auto found = numbers(key, 3, 0, most);
    if (!found) return std::nullopt;
    return Rgb((*found)[0], (*found)[1], (*found)[2]);
}

}  // namespace chiaro
