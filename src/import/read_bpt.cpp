#include "import/read_bpt.h"

#include "import/fault.h"
#include "import/finish_scene.h"
#include "import/load_scene.h"
#include "import/read_mtl.h"
#include "import/text_lines.h"
#include "scene/bicubic_mesh.h"

#include <fmt/format.h>

#include <charconv>

namespace chiaro {
namespace {

class BptReader {
public:
    explicit BptReader(const SceneFile& file) : file_(file), lines_(file.bytes, file.where) {}

    Scene read(const std::string& name) {
        Scene scene;
        const MaterialId material = MtlMaterials(scene, file_.folder).fallback();
        Mesh mesh;
        mesh.name = name;
        // Patches are stored as they are read: what the count promises takes no memory.
        const std::size_t count = read_count();
        for (std::size_t patch = 0; patch < count; ++patch)
            add_bicubic(mesh, read_patch(patch, count), material);
        if (lines_.next()) lines_.refuse(fmt::format("more follows the {} patches", count));

        scene.meshes.push_back(std::move(mesh));
        scene.objects.push_back({name, MeshId{0}, Mat4(1)});
        drop_unseen(scene, file_.where);
        return scene;
    }

private:
    std::size_t read_count() {
        if (!lines_.next()) throw Error(file_.where, "the number of patches is missing");
        const std::string_view digits = lines_.word();
        std::size_t count = 0;
        const auto [end, status] =
            std::from_chars(digits.data(), digits.data() + digits.size(), count);
        if (status != std::errc() || end != digits.data() + digits.size() || count == 0)
            lines_.refuse(fmt::format("\"{}\" is not a number of patches", printable(digits)));
        end_line();
        return count;
    }

    BicubicPatch read_patch(std::size_t patch, std::size_t count) {
        next_line(patch, count);
        const std::string_view u = lines_.word(), v = lines_.word();
        if (u != "3" || v != "3")
            lines_.refuse(
                fmt::format("the degrees of patch {} are \"{} {}\": only bicubic patches, 3 3, "
                            "are supported",
                            patch + 1, printable(u), printable(v)));
        end_line();
        std::array<Vec3, 16> points;
        for (Vec3& point : points) {
            next_line(patch, count);
            point.x = lines_.number_word("x");
            point.y = lines_.number_word("y");
            point.z = lines_.number_word("z");
            end_line();
            if (!within_reach(point)) lines_.refuse("a control point lies beyond 1e9");
        }
        return make_bicubic(points);
    }

    void next_line(std::size_t patch, std::size_t count) {
        if (!lines_.next())
            throw Error(file_.where,
                        fmt::format("the file ends in patch {} of {}", patch + 1, count));
    }

    void end_line() {
        const std::string_view more = lines_.word();
        if (!more.empty())
            lines_.refuse(fmt::format("\"{}\" is one word too many", printable(more)));
    }

    const SceneFile& file_;
    TextLines lines_;
};

}  // namespace

Scene read_bpt(const SceneFile& file, const std::string& name) {
    return BptReader(file).read(name);
}

}  // namespace chiaro
