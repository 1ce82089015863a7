#include "import/read_mtl.h"

#include "import/add_texture.h"
#include "import/fault.h"
#include "import/image_file.h"
#include "import/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace chiaro {

// Reads one MTL file into the definitions of an MtlMaterials.
class MtlReader {
public:
    MtlReader(MtlMaterials& materials, const std::string& text, std::filesystem::path subfolder,
              const std::string& where)
        : materials_(materials), lines_(text, where), subfolder_(std::move(subfolder)) {}

    void read_all() {
        while (lines_.next()) {
            const std::string_view key = lines_.word();
            if (key == "newmtl")
                begin_material();
            else if (current_ != nullptr)
                read_property(key);
        }
    }

private:
    using Definition = MtlMaterials::Definition;
    using Map = MtlMaterials::Map;

    void begin_material() {
        const std::string name(lines_.remainder());
        current_ = &materials_.definitions_[name];
        *current_ = Definition();
        current_->material.name = name;
        current_->material.gloss.model = GlossModel::phong;
    }

    void read_property(std::string_view key) {
        Material& material = current_->material;
        Gloss& gloss = material.gloss;
        if (key == "Kd")
            material.base_color = glm::clamp(color("Kd"), 0.0f, 1.0f);
        else if (key == "Ke")
            material.emission = glm::max(color("Ke"), Rgb(0));
        else if (key == "Ks")
            gloss.specular = glm::clamp(color("Ks"), 0.0f, 1.0f);
        else if (key == "Ns")
            gloss.shininess = std::max(lines_.number_word("Ns"), 0.0f);
        else if (key == "Ni")
            gloss.ior = lines_.number_word("Ni");
        else if (key == "illum")
            gloss.illumination_model =
                static_cast<int>(std::clamp(lines_.number_word("illum"), 0.0f, 100.0f));
        else if (key == "Tf")
            gloss.transmission_color = glm::clamp(color("Tf"), 0.0f, 1.0f);
        else if (key == "Pr")
            gloss.roughness = physical_number("Pr");
        else if (key == "Pm")
            gloss.metallic = physical_number("Pm");
        else if (key == "d")
            read_opacity();
        else if (key == "Tr")
            set_alpha(1 - unit_number("Tr"));
        else
            read_map_property(key);
    }

    void read_map_property(std::string_view key) {
        if (key == "map_Kd")
            current_->diffuse = map();
        else if (key == "map_Ke")
            current_->emission = map();
        else if (key == "map_d")
            current_->alpha = map();
        else if (key == "bump" || key == "map_bump" || key == "map_Bump" || key == "norm")
            note_bump_map();
    }

    void note_bump_map() {
        if (!materials_.has_bump_maps_)
            materials_.scene_.warnings.push_back(
                lines_.where() + ": bump and normal maps are not supported and were left out");
        materials_.has_bump_maps_ = true;
    }

    // Of the parameters that glTF has too and exporters write beside those of Phong.
    float physical_number(const char* name) {
        current_->material.gloss.model = GlossModel::metallic_roughness;
        return unit_number(name);
    }

    float unit_number(const char* name) { return std::clamp(lines_.number_word(name), 0.0f, 1.0f); }

    // One number stands for three alike; colours as spectra are not read.
    Rgb color(const char* name) {
        const std::string_view first = lines_.word();
        if (first == "spectral" || first == "xyz")
            lines_.refuse(fmt::format("{} {} is not supported", name, first));
        const float red = lines_.to_number(first, name);
        const std::optional<float> green = lines_.optional_number(name);
        if (!green) return Rgb(red);
        return {red, *green, lines_.number_word(name)};
    }

    void read_opacity() {
        const std::string_view first = lines_.word();
        if (first != "-halo") set_alpha(std::clamp(lines_.to_number(first, "d"), 0.0f, 1.0f));
    }

    void set_alpha(float alpha) {
        current_->material.alpha = alpha;
        current_->material.alpha_mode = alpha < 1 ? AlphaMode::blend : AlphaMode::opaque;
    }

    // `[options] file`: the options of which we know how many words follow; the name may have
    // spaces in it, so it is all that is left.
    Map map() {
        Map map;
        map.where = lines_.where();
        std::string_view name = lines_.remainder();
        while (name.starts_with('-')) {
            MapOption option(name);
            if (option.key == "-o") map.offset = option.pair(0);
            if (option.key == "-s") map.scale = option.pair(1);
            if (option.key == "-clamp") map.clamp = option.words.front() == "on";
            if (option.key == "-mm") map.gain = option.pair(1).y;
            name = option.rest;
        }
        if (without_comment(name).empty()) lines_.refuse("a map without the name of a file");
        map.file = file_called(name);
        std::error_code ignored;
        if (!std::filesystem::exists(materials_.folder_ / map.file, ignored))
            map.file = file_called(without_comment(name));
        return map;
    }

    std::filesystem::path file_called(std::string_view name) const {
        std::string file(name);
        std::ranges::replace(file, '\\', '/');
        return subfolder_ / file;
    }

    // One option of a map: its key and the words that belong to it.
    struct MapOption {
        std::string_view key, rest;
        std::vector<std::string_view> words;

        explicit MapOption(std::string_view text) : rest(text) {
            key = take();
            const bool numbers = key == "-o" || key == "-s" || key == "-t" || key == "-mm";
            const bool one = key == "-clamp" || key == "-blendu" || key == "-blendv" ||
                             key == "-cc" || key == "-imfchan" || key == "-type" ||
                             key == "-texres" || key == "-bm" || key == "-boost";
            if (one) words.push_back(take());
            while (numbers && words.size() < (key == "-mm" ? 2u : 3u) && parse_number(peek()))
                words.push_back(take());
            if (words.empty()) words.emplace_back();
        }
        std::string_view peek() const { return rest.substr(0, rest.find_first_of(" \t")); }
        std::string_view take() {
            const std::string_view word = peek();
            rest.remove_prefix(word.size());
            rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
            return word;
        }
        // The first two numbers; `missing` where there is none.
        Vec2 pair(float missing) const {
            const auto number = [&](std::size_t i) {
                const auto value = i < words.size() ? parse_number(words[i]) : std::nullopt;
                const auto rounded = static_cast<float>(value.value_or(missing));
                return std::isfinite(rounded) ? rounded : missing;
            };
            return {number(0), number(1)};
        }
    };

    MtlMaterials& materials_;
    TextLines lines_;
    std::filesystem::path subfolder_;
    Definition* current_ = nullptr;
};

// False if there is no such file.
bool MtlMaterials::read_library(const std::string& name, const std::string& where) {
    const std::filesystem::path path = resolve_beside(folder_, name, where);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    const std::string shown = printable(path.string());
    const std::string text = read_whole_file(path, shown);
    const auto subfolder = std::filesystem::path(name).lexically_normal().parent_path();
    MtlReader(*this, text, subfolder, shown).read_all();
    return true;
}

void MtlMaterials::read_libraries(std::string names, const std::string& where) {
    std::ranges::replace(names, '\\', '/');
    const std::string plain(without_comment(names));
    if (plain.empty()) throw Error(where, "mtllib names no file");
    // Names with spaces in them look like several, and those with a # like a comment: the whole is
    // tried first.
    if (read_library(names, where) || read_library(plain, where)) return;
    for (std::size_t start = 0; start < plain.size();) {
        const std::size_t end = std::min(plain.find_first_of(" \t", start), plain.size());
        const std::string name = plain.substr(start, end - start);
        start = std::min(plain.find_first_not_of(" \t", end), plain.size());
        if (!read_library(name, where))
            scene_.warnings.push_back(
                fmt::format("{}: there is no file \"{}\" of materials", where, printable(name)));
    }
}

TextureUse MtlMaterials::use(const Map& map) {
    if (map.file.empty()) return {};
    const auto [known, fresh] =
        textures_.try_emplace({map.file.string(), map.clamp}, TextureId::none);
    if (fresh) {
        const std::filesystem::path path = resolve_beside(folder_, map.file.string(), map.where);
        const std::string where = map.where + ": " + printable(map.file.string());
        const std::string bytes = read_whole_file(path, where);
        Texture texture = read_texture(
            {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, where);
        texture.name = map.file.filename().string();
        texture.wrap_u = texture.wrap_v = map.clamp ? Wrap::clamp_to_edge : Wrap::repeat;
        known->second = add_texture(scene_, std::move(texture), where);
    }
    // The image's bottom left is OBJ's origin: v is measured down from 1, and so is the transform.
    TextureUse use;
    use.texture = known->second;
    use.scale = map.scale;
    use.offset = Vec2(map.offset.x, 1 - map.scale.y - map.offset.y);
    return use;
}

void MtlMaterials::load_maps(const Definition& definition) {
    Material& material = scene_.materials[index_of(definition.id)];
    const auto& [diffuse, emission, alpha] =
        std::tie(definition.diffuse, definition.emission, definition.alpha);
    material.base_color_texture = use(diffuse);
    material.emission_texture = use(emission);

    // Colour and map multiply. Exporters that let the map replace the colour write it as black.
    if (material.base_color_texture.used()) {
        if (material.base_color == Rgb(0)) material.base_color = Rgb(1);
        material.base_color = glm::clamp(diffuse.gain * material.base_color, 0.0f, 1.0f);
    }
    if (material.emission_texture.used()) {
        if (material.emission == Rgb(0)) material.emission = Rgb(1);
        material.emission = glm::max(emission.gain * material.emission, Rgb(0));
    }
    if (alpha.file.empty()) return;
    if (alpha.file != diffuse.file)
        scene_.warnings.push_back(alpha.where +
                                  ": map_d is read only where it is the file of map_Kd");
    else if (material.alpha_mode == AlphaMode::opaque)
        material.alpha_mode = AlphaMode::mask;
}

// Glass (illum 4, 6, 7). Exporters write illum 4 for surfaces of all kinds; an index of 1 betrays
// those. What passes glass is its Fresnel's and Tf's business, not that of `d`.
void set_transmission(Material& material) {
    const int model = material.gloss.illumination_model;
    if ((model != 4 && model != 6 && model != 7) || !(material.gloss.ior > 1)) return;
    material.gloss.transmission = 1;
    material.alpha = 1;
    material.alpha_mode = AlphaMode::opaque;
}

MaterialId MtlMaterials::find(const std::string& name) {
    auto found = definitions_.find(name);
    if (found == definitions_.end()) found = definitions_.find(std::string(without_comment(name)));
    if (found == definitions_.end()) return MaterialId::none;
    Definition& definition = found->second;
    if (definition.id == MaterialId::none) {
        set_transmission(definition.material);
        definition.id = static_cast<MaterialId>(scene_.materials.size());
        scene_.materials.push_back(definition.material);
        found_.push_back(definition);
    }
    return definition.id;
}

void MtlMaterials::load_textures(const std::vector<bool>& in_use) {
    for (const Definition& definition : found_)
        if (in_use[index_of(definition.id)]) load_maps(definition);
}

MaterialId MtlMaterials::fallback() {
    if (fallback_ == MaterialId::none) {
        fallback_ = static_cast<MaterialId>(scene_.materials.size());
        scene_.materials.emplace_back().name = "default";
    }
    return fallback_;
}

}  // namespace chiaro
