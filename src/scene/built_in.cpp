#include "scene/built_in.h"

namespace chiaro {
namespace {

struct BuiltIn {
    const char* name;
    Scene (*make)();
};

constexpr BuiltIn kBuiltIns[] = {{"room", make_room},
                                 {"indirect", make_indirect},
                                 {"poolhall", make_poolhall},
                                 {"cornell", make_cornell_box}};

}  // namespace

std::vector<std::string> built_in_names() {
    std::vector<std::string> names;
    for (const BuiltIn& built_in : kBuiltIns) names.push_back(built_in.name);
    return names;
}

std::optional<Scene> built_in_scene(std::string_view name) {
    for (const BuiltIn& built_in : kBuiltIns)
        if (built_in.name == name) return built_in.make();
    return std::nullopt;
}

}  // namespace chiaro
