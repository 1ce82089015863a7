#include "import/obj_tags.h"

#include "import/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace chiaro {
namespace {

// What a tag brings: `name integers/floats/strings` and then as many of each.
struct Tag {
    std::string name;
    std::vector<std::uint32_t> integers;
    std::vector<float> floats;
    std::string text;  // the last of its strings
};

template <typename T>
T read_whole(TextLines& lines, std::string_view word, const char* what) {
    T value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size())
        lines.refuse(fmt::format("tag: \"{}\" is not {}", printable(word), what));
    return value;
}

std::array<std::uint32_t, 3> read_counts(TextLines& lines) {
    std::string_view rest = lines.word();
    std::array<std::uint32_t, 3> counts;
    for (int k = 0; k < 3; ++k) {
        const std::size_t slash = k < 2 ? rest.find('/') : rest.size();
        counts[k] = read_whole<std::uint32_t>(lines, rest.substr(0, slash), "a count");
        rest = slash < rest.size() ? rest.substr(slash + 1) : std::string_view();
    }
    return counts;
}

Tag read_words(TextLines& lines, std::string_view name) {
    Tag tag;
    tag.name = name;
    const auto [integers, floats, strings] = read_counts(lines);
    for (std::uint32_t k = 0; k < integers; ++k)
        tag.integers.push_back(read_whole<std::uint32_t>(lines, lines.word(), "an index"));
    for (std::uint32_t k = 0; k < floats; ++k) tag.floats.push_back(lines.number_word("sharpness"));
    for (std::uint32_t k = 0; k < strings; ++k) {
        const std::string_view word = lines.word();
        if (word.empty()) lines.refuse("tag: a string is missing");
        tag.text = word;
    }
    return tag;
}

// One sharpness for all, or one for each.
float sharpness_of(const Tag& tag, std::size_t index, const TextLines& lines) {
    if (tag.floats.empty()) lines.refuse("tag: the sharpness is missing");
    const float sharpness = tag.floats[std::min(index, tag.floats.size() - 1)];
    return std::clamp(sharpness, 0.0f, kInfinitelySharp);
}

void read_crease(const Tag& tag, const TextLines& lines, ObjTags& tags) {
    if (tag.integers.size() < 2) lines.refuse("tag: a crease needs 2 vertices");
    for (std::size_t k = 0; k + 1 < tag.integers.size(); ++k)
        tags.creases.push_back({tag.integers[k], tag.integers[k + 1], sharpness_of(tag, k, lines)});
}

void read_corner(const Tag& tag, const TextLines& lines, ObjTags& tags) {
    for (std::size_t k = 0; k < tag.integers.size(); ++k)
        tags.corners.push_back({tag.integers[k], sharpness_of(tag, k, lines)});
}

template <typename Rule>
Rule read_rule(const Tag& tag, const TextLines& lines, std::uint32_t most) {
    if (tag.integers.size() != 1 || tag.integers[0] > most)
        lines.refuse(fmt::format("tag: {} takes one number from 0 to {}", tag.name, most));
    return static_cast<Rule>(tag.integers[0]);
}

}  // namespace

void read_tag(TextLines& lines, ObjTags& tags) {
    static const std::set<std::string_view> kKnown = {
        "crease",      "corner", "hole", "interpolateboundary", "facevaryinginterpolateboundary",
        "creasemethod"};
    const std::string_view name = lines.word();
    if (!kKnown.contains(name)) {
        constexpr std::size_t kMostNames = 8;
        if (tags.unknown.size() < kMostNames) tags.unknown.insert(printable(name));
        return;
    }
    const Tag tag = read_words(lines, name);
    tags.any = true;
    if (name == "crease") {
        read_crease(tag, lines, tags);
    } else if (name == "corner") {
        read_corner(tag, lines, tags);
    } else if (name == "hole") {
        tags.holes.insert(tag.integers.begin(), tag.integers.end());
    } else if (name == "interpolateboundary") {
        tags.rules.boundary = read_rule<BoundaryRule>(tag, lines, 2);
    } else if (name == "facevaryinginterpolateboundary") {
        tags.rules.uvs = read_rule<UvRule>(tag, lines, 3);
    } else {
        if (tag.text != "normal" && tag.text != "chaikin")
            lines.refuse("tag: creasemethod is normal or chaikin");
        tags.rules.chaikin = tag.text == "chaikin";
    }
}

}  // namespace chiaro
