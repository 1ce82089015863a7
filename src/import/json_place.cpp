#include "import/json_place.h"

#include "import/fault.h"
#include "import/glb.h"

#include <fmt/format.h>

namespace chiaro {
namespace {

using Json = nlohmann::json;

struct Walk {
    const std::string& file;
    const JsonVisitor& visit;

    void go(const Json* value, std::string_view pattern, const JsonPlace& place) const {
        if (pattern.empty()) return visit(value, place);
        if (value == nullptr) return;
        const std::size_t end = std::min(pattern.find('/'), pattern.size());
        const std::string_view step = pattern.substr(0, end);
        const std::string_view rest = pattern.substr(std::min(end + 1, pattern.size()));
        if (step == "*" && value->is_array()) return each_element(*value, rest, place);
        if (!value->is_object())
            refuse(file, place, step == "*" ? "is not an array" : "is not an object");
        if (step == "*" || step == "~") return each_member(*value, step == "~", rest, place);
        const auto member = value->find(step);
        go(member == value->end() ? nullptr : &*member, rest, {&place, step});
    }

    void each_element(const Json& array, std::string_view rest, const JsonPlace& place) const {
        for (std::size_t i = 0; i < array.size(); ++i) go(&array[i], rest, {&place, {}, i});
    }

    void each_member(const Json& object, bool only_objects, std::string_view rest,
                     const JsonPlace& place) const {
        for (auto member = object.begin(); member != object.end(); ++member)
            if (!only_objects || member->is_object()) go(&*member, rest, {&place, member.key()});
    }
};

}  // namespace

Json parse_json(std::string_view text, const std::string& where) {
    if (text.starts_with("\xef\xbb\xbf"))
        throw Error(where, "JSON: the file begins with a byte order mark",
                    "save it as UTF-8 without one");
    check_json_depth(text, where);
    try {
        return Json::parse(text);
    } catch (const Json::exception& fault) {
        // What follows "[json.exception.parse_error.101] ".
        const std::string_view what = fault.what();
        const std::size_t start = what.find("] ");
        throw Error(where,
                    "JSON: " + printable(start == what.npos ? what : what.substr(start + 2)));
    }
}

std::string JsonPlace::path() const {
    if (parent == nullptr) return "";
    const std::string above = parent->path();
    if (key.empty()) return fmt::format("{}[{}]", above, index);
    return above + (above.empty() ? "" : ".") + printable(key);
}

void refuse(const std::string& file, const JsonPlace& place, const std::string& what) {
    const std::string path = place.path();
    throw Error(path.empty() ? file : file + ": " + path, what);
}

void visit_json(const Json& root, std::string_view pattern, const std::string& file,
                const JsonVisitor& visit) {
    Walk{file, visit}.go(&root, pattern, {});
}

}  // namespace chiaro
