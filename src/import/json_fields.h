// Members of a JSON object, read by their keys and refused by name.
#pragma once

#include "base/color.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro {

/// Every reader throws an Error at "place.key" if the member is of another type, not finite or out
/// of range; an absent member is nothing.
class JsonFields {
public:
    /// `place` is what messages call the object; that of a whole file ends with ": ". Throws an
    /// Error if `object` is no object or has any key that is not in `keys`. Keeps a reference to
    /// it.
    JsonFields(const nlohmann::json& object, std::string place,
               std::initializer_list<std::string_view> keys);

    bool has(const char* key) const { return object_.contains(key); }
    std::string where(std::string_view key) const;
    const nlohmann::json& at(const char* key) const { return object_[key]; }

    std::optional<float> number(const char* key, double low, double high) const;
    std::optional<bool> flag(const char* key) const;
    std::optional<std::string> text(const char* key) const;
    /// Coordinates or components, each within +-`most`.
    std::optional<Vec3> vector(const char* key, double most) const;
    /// As vector(), not zero.
    std::optional<Vec3> direction(const char* key) const;
    /// Linear, each channel in [0, most].
    std::optional<Rgb> color(const char* key, double most) const;
    /// So many numbers in [low, high].
    std::optional<std::vector<float>> numbers(const char* key, std::size_t count, double low,
                                              double high) const;

private:
    const nlohmann::json& object_;
    std::string place_;
};

/// A number of the JSON document, finite and within the range, or an Error at `where`.
double read_number(const nlohmann::json& value, double low, double high, const std::string& where);

}  // namespace chiaro
