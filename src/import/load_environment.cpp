#include "import/load_environment.h"

#include "import/fault.h"
#include "import/image_file.h"
#include "import/load_scene.h"

#include <fmt/format.h>

#include <new>

namespace chiaro {
namespace {

const char* fault_of(Rgb radiance) {
    if (!glm::all(glm::greaterThanEqual(radiance, Rgb(0))))
        return radiance == radiance ? "is negative" : "is not a number";
    if (!(max_component(radiance) <= kBrightest)) return "is brighter than 1e15 cd/m2";
    return nullptr;
}

}  // namespace

Environment load_environment(const std::filesystem::path& file) {
    const std::string where = printable(file.string());
    try {
        Environment environment = {.map = read_image(file)};
        const Image& map = environment.map;
        for (std::size_t i = 0; i < map.pixels.size(); ++i)
            if (const char* fault = fault_of(map.pixels[i]))
                throw Error(where,
                            fmt::format("pixel ({}, {}) {}", i % map.width, i / map.width, fault));
        return environment;
    } catch (const std::bad_alloc&) {
        throw Error(where, "there is not enough memory for this picture");
    }
}

}  // namespace chiaro
