#include "import/read_obj.h"

#include "import/directions.h"
#include "import/fault.h"
#include "import/finish_scene.h"
#include "import/obj_cage.h"
#include "import/obj_geometry.h"
#include "import/obj_tags.h"
#include "import/read_mtl.h"
#include "import/subdivide.h"
#include "import/text_lines.h"
#include "import/unique_names.h"
#include "scene/enclosure.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <set>

namespace chiaro {
namespace {

// More faces or corners than this do not fit the indices of a mesh, or any use.
constexpr std::size_t kMaxCorners = 400'000'000;

// The largest index of a kind that a face names, to be held against the list at the end of the
// file: a face may come before the points that it names.
struct LargestIndex {
    std::int64_t index = -1;
    std::uint32_t line = 0;
};

class ObjReader {
public:
    ObjReader(const SceneFile& file, bool subdivide)
        : file_(file),
          subdivide_(subdivide),
          lines_(file.bytes, file.where),
          free_form_(lines_),
          materials_(scene_, file.folder) {}

    Scene read() {
        while (lines_.next()) read_statement();
        free_form_.check_ended();
        check_indices();
        if (faces_ == 0 && surfaces_ == 0) refuse_nothing();
        make_objects();
        const std::vector<bool> in_use = drop_unseen(scene_, file_.where);
        decide_thin(scene_);
        materials_.load_textures(in_use);
        add_warnings();
        return std::move(scene_);
    }

private:
    void read_statement() {
        const std::string_view key = lines_.word();
        if (key == "v")
            read_position();
        else if (key == "vt")
            read_texture_coordinates();
        else if (key == "vn")
            read_normal();
        else if (key == "f" || key == "fo")
            read_face();
        else if (key == "surf")
            read_surface();
        else if (key == "end")
            end_surface();
        else if (key == "t")
            read_tag(lines_, tags_);
        else if (key == "o" || key == "g")
            begin_part(key == "o");
        else if (key == "usemtl")
            use_material();
        else if (key == "mtllib")
            materials_.read_libraries(std::string(lines_.remainder()), lines_.where());
        else if (!free_form_.read(key))
            note_other(key);
    }

    void note_other(std::string_view key) {
        static const std::set<std::string_view> kSilent = {
            "s",         "mg",    "bevel", "c_interp", "d_interp", "lod", "shadow_obj",
            "trace_obj", "ctech", "stech", "usemap",   "maplib",   "res"};
        if (key == "l" || key == "p") {
            ++points_and_lines_;
        } else if (!kSilent.contains(key) && unknown_.size() < 8) {
            unknown_.insert(printable(key));
        }
    }

    void read_position() {
        Vec3 position;
        position.x = lines_.number_word("x");
        position.y = lines_.number_word("y");
        position.z = lines_.number_word("z");
        std::array<float, 4> more;  // w; r g b; r g b a
        std::size_t count = 0;
        while (count < more.size()) {
            const std::optional<float> value = lines_.optional_number("v");
            if (!value) break;
            more[count++] = *value;
        }
        if (count >= 3) {
            geometry_.colors.resize(geometry_.v.size(), Vec3(1));
            geometry_.colors.push_back(
                glm::clamp(Vec3(more[0], more[1], more[2]), Vec3(0), Vec3(1)));
        } else if (!geometry_.colors.empty()) {
            geometry_.colors.emplace_back(1);
        }
        if (count == 1 || !geometry_.weights.empty()) {
            geometry_.weights.resize(geometry_.v.size(), 1);
            geometry_.weights.push_back(count == 1 ? more[0] : 1);
        }
        geometry_.v.push_back(position);
    }

    void read_texture_coordinates() {
        const float u = lines_.number_word("u");
        geometry_.vt.emplace_back(u, lines_.optional_number("v").value_or(0));
    }

    void read_normal() {
        const float x = lines_.number_word("x"), y = lines_.number_word("y");
        geometry_.vn.push_back(unit_or_zero({x, y, lines_.number_word("z")}));
    }

    // A position in a list from what a face says: from 1, or from its end so far if negative.
    std::uint32_t read_index(std::string_view digits, std::size_t count, LargestIndex& largest,
                             std::string_view corner) {
        std::int64_t index = 0;
        if (digits.starts_with('+')) digits.remove_prefix(1);
        const auto [end, status] =
            std::from_chars(digits.data(), digits.data() + digits.size(), index);
        if (status != std::errc() || end != digits.data() + digits.size())
            lines_.refuse(fmt::format("\"{}\" is not a corner of a face", printable(corner)));
        if (index == 0)
            lines_.refuse(fmt::format("corner \"{}\": indices count from 1", printable(corner)));
        const std::int64_t position =
            index > 0 ? index - 1 : static_cast<std::int64_t>(count) + index;
        if (position < 0 || position >= std::int64_t{0xffff'ffff})
            lines_.refuse(
                fmt::format("corner \"{}\": there are {} before it", printable(corner), count));
        if (position > largest.index) largest = {position, lines_.number()};
        return static_cast<std::uint32_t>(position);
    }

    // v, v/vt, v//vn or v/vt/vn.
    ObjCorner read_corner(std::string_view text) {
        std::array<std::string_view, 3> fields;
        std::string_view rest = text;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t slash = rest.find('/');
            fields[i] = rest.substr(0, slash);
            if (slash == rest.npos) {
                rest = {};
                break;
            }
            rest.remove_prefix(slash + 1);
            if (i == 2) lines_.refuse(fmt::format("\"{}\" is not a corner", printable(text)));
        }
        ObjCorner corner;
        corner.v = read_index(fields[0], geometry_.v.size(), largest_v_, text);
        if (!fields[1].empty())
            corner.vt = read_index(fields[1], geometry_.vt.size(), largest_vt_, text);
        if (!fields[2].empty())
            corner.vn = read_index(fields[2], geometry_.vn.size(), largest_vn_, text);
        return corner;
    }

    // The corners that the line names; returns how many.
    std::size_t read_corners() {
        const std::size_t first = geometry_.corners.size();
        for (std::string_view text = lines_.word(); !text.empty(); text = lines_.word())
            geometry_.corners.push_back(read_corner(text));
        if (geometry_.corners.size() > kMaxCorners) lines_.refuse("there are too many faces");
        return geometry_.corners.size() - first;
    }

    void read_face() {
        const std::size_t first = geometry_.corners.size(), count = read_corners();
        if (count < 3)
            lines_.refuse(fmt::format("a face needs at least 3 corners and has {}", count));
        current_part().faces.push_back({static_cast<std::uint32_t>(first),
                                        static_cast<std::uint32_t>(count), current_material(),
                                        lines_.number(), static_cast<std::uint32_t>(faces_)});
        ++faces_;
    }

    void read_surface() {
        free_form_.begin_surface();
        const std::size_t first = geometry_.corners.size();
        free_form_.set_corners(first, read_corners());
    }

    void end_surface() {
        const std::optional<FreeFormSurface> surface = free_form_.end();
        if (!surface) return;
        current_part().surfaces.push_back({*surface, current_material()});
        ++surfaces_;
    }

    void begin_part(bool is_object) {
        std::string name;
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word())
            name += (name.empty() ? "" : " ") + std::string(word);
        if (is_object) {
            object_ = name;
            group_.clear();
        } else {
            group_ = name;
        }
        part_ = kNoPart;
    }

    // The part that `o` and `g` name: "object", "group" or "object/group".
    ObjPart& current_part() {
        if (part_ == kNoPart) {
            const bool joined = !object_.empty() && !group_.empty() && object_ != group_;
            const std::string name =
                joined ? object_ + "/" + group_ : (object_.empty() ? group_ : object_);
            const auto [known, fresh] = part_of_.try_emplace(name, geometry_.parts.size());
            if (fresh) geometry_.parts.push_back({name, {}, {}});
            part_ = known->second;
        }
        return geometry_.parts[part_];
    }

    void use_material() {
        material_ = MaterialId::none;
        material_name_ = lines_.remainder();
        material_line_ = lines_.number();
    }

    // Looked up when a face needs it: a material that none has is no concern of ours.
    MaterialId current_material() {
        if (material_ != MaterialId::none) return material_;
        if (material_line_ > 0) material_ = materials_.find(material_name_);
        if (material_ != MaterialId::none) return material_;
        if (material_line_ > 0 && missing_materials_.insert(material_name_).second)
            scene_.warnings.push_back(
                fmt::format("{}: material \"{}\" is not defined; grey takes its place",
                            lines_.where(material_line_), printable(material_name_)));
        return material_ = materials_.fallback();
    }

    void check_indices() const {
        const auto check_kind = [&](const LargestIndex& largest, std::size_t count,
                                    const char* kind) {
            if (largest.index >= static_cast<std::int64_t>(count))
                throw Error(lines_.where(largest.line),
                            fmt::format("a face names {} {}, but there are {}", kind,
                                        largest.index + 1, count));
        };
        check_kind(largest_v_, geometry_.v.size(), "v");
        check_kind(largest_vt_, geometry_.vt.size(), "vt");
        check_kind(largest_vn_, geometry_.vn.size(), "vn");
    }

    [[noreturn]] void refuse_nothing() const {
        for (const auto& [what, line] : free_form_.left_out())
            throw Error(lines_.where(line), what + " are not supported",
                        "there is no other surface in the file");
        throw Error(file_.where, "there is no face in the file");
    }

    Mesh make_mesh_of(const ObjPart& part) {
        if (part.faces.empty() || !(subdivide_ || tags_.any))
            return make_mesh(geometry_, part, file_.where);
        Mesh mesh = subdivide(make_cage(geometry_, part, tags_), file_.where, scene_.warnings);
        add_surfaces(geometry_, part, file_.where, mesh);
        return mesh;
    }

    void make_objects() {
        if (!geometry_.colors.empty()) geometry_.colors.resize(geometry_.v.size(), Vec3(1));
        UniqueNames object_name, material_name;
        for (ObjPart& part : geometry_.parts) {
            part.name = object_name(part.name, "object");
            scene_.objects.push_back(
                {part.name, static_cast<MeshId>(scene_.meshes.size()), Mat4(1)});
            scene_.meshes.push_back(make_mesh_of(part));
        }
        for (Material& material : scene_.materials)
            material.name = material_name(material.name, "material");
    }

    void add_warnings() {
        const auto add = [&](const std::string& what) {
            scene_.warnings.push_back(file_.where + ": " + what);
        };
        for (const auto& [what, line] : free_form_.left_out())
            scene_.warnings.push_back(lines_.where(line) + ": " + what +
                                      " are not supported and were left out");
        for (const std::string& name : tags_.unknown)
            add(fmt::format("tags \"{}\" are not supported and were left out", name));
        if (points_and_lines_ > 0) add("points and lines were left out");
        for (const std::string& key : unknown_)
            add(fmt::format("statements \"{}\" are unknown and were left out", key));
    }

    static constexpr std::size_t kNoPart = static_cast<std::size_t>(-1);

    const SceneFile& file_;
    bool subdivide_;
    TextLines lines_;
    ObjFreeForm free_form_;
    ObjTags tags_;
    Scene scene_;
    MtlMaterials materials_;
    ObjGeometry geometry_;
    std::string object_, group_;
    std::size_t part_ = kNoPart;
    std::unordered_map<std::string, std::size_t> part_of_;
    MaterialId material_ = MaterialId::none;  // none: not looked up yet
    std::string material_name_;
    std::uint32_t material_line_ = 0;  // of its usemtl; 0: there was none
    LargestIndex largest_v_, largest_vt_, largest_vn_;
    std::size_t faces_ = 0, surfaces_ = 0;
    std::size_t points_and_lines_ = 0;
    std::set<std::string> unknown_, missing_materials_;
};

}  // namespace

Scene read_obj(const SceneFile& file, bool subdivide) {
    return ObjReader(file, subdivide).read();
}

}  // namespace chiaro
