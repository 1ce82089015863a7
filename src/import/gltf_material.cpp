#include "import/gltf_material.h"

#include "import/add_texture.h"
#include "import/fault.h"
#include "import/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace chiaro {
namespace {

using tinygltf::Value;

// A member of an extension object; null if the extension or the member is absent.
const Value* find(const tinygltf::ExtensionMap& extensions, const char* extension,
                  const char* member) {
    const auto found = extensions.find(extension);
    if (found == extensions.end() || !found->second.Has(member)) return nullptr;
    return &found->second.Get(member);
}

float number(const tinygltf::ExtensionMap& extensions, const char* extension, const char* member,
             float fallback) {
    const Value* value = find(extensions, extension, member);
    return value == nullptr ? fallback : static_cast<float>(value->GetNumberAsDouble());
}

template <int count>
glm::vec<count, float> numbers(const tinygltf::ExtensionMap& extensions, const char* extension,
                               const char* member, glm::vec<count, float> fallback) {
    const Value* value = find(extensions, extension, member);
    if (value == nullptr) return fallback;
    glm::vec<count, float> result;
    for (int i = 0; i < count; ++i)
        result[i] = static_cast<float>(value->Get(i).GetNumberAsDouble());
    return result;
}

Rgb to_rgb(const std::vector<double>& numbers) {
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2])};
}

Wrap wrap_mode(int mode, const std::string& where) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp_to_edge;
        default:
            throw Error(where, fmt::format("{} is no way to wrap a texture", mode));
    }
}

AlphaMode alpha_mode(const std::string& mode, const std::string& where) {
    if (mode == "OPAQUE") return AlphaMode::opaque;
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    throw Error(where + ".alphaMode", fmt::format("\"{}\" is unknown", printable(mode)));
}

}  // namespace

MaterialId GltfMaterials::get(int index) {
    const auto id = static_cast<MaterialId>(scene_.materials.size());
    const auto [known, fresh] = known_.try_emplace(index, id);
    if (fresh)
        scene_.materials.emplace_back().name =
            index < 0 ? unique_name_("default", "material")
                      : unique_name_(document_.model().materials[index].name, "material");
    return known->second;
}

void GltfMaterials::read(const std::vector<bool>& in_use) {
    for (const auto& [index, id] : known_) {
        if (!in_use[index_of(id)]) continue;
        Material& material = scene_.materials[index_of(id)];
        if (index < 0)
            read(tinygltf::Material(), document_.where("materials"), material);
        else
            read(document_.model().materials[index],
                 document_.where(fmt::format("materials[{}]", index)), material);
    }
    if (!normal_map_.empty())
        scene_.warnings.push_back(normal_map_ +
                                  ": normal maps are not supported and were left out");
    if (!extension_map_.empty())
        scene_.warnings.push_back(extension_map_ +
                                  ": textures of this extension are not supported and were left "
                                  "out");
    warn_of_unused_images();
}

void GltfMaterials::read(const tinygltf::Material& source, const std::string& place,
                         Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    material.base_color = glm::clamp(to_rgb(pbr.baseColorFactor), 0.0f, 1.0f);
    material.alpha = std::clamp(static_cast<float>(pbr.baseColorFactor[3]), 0.0f, 1.0f);
    material.base_color_texture =
        use(pbr.baseColorTexture, true, place + ".pbrMetallicRoughness.baseColorTexture");
    material.alpha_mode = alpha_mode(source.alphaMode, place);
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    material.emits_backward = source.doubleSided;
    read_emission(source, place, material);
    read_gloss(source, place, material);
    if (source.normalTexture.index >= 0 && normal_map_.empty())
        normal_map_ = place + ".normalTexture";
}

void GltfMaterials::read_emission(const tinygltf::Material& source, const std::string& place,
                                  Material& material) {
    const float strength =
        number(source.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    const Rgb factor = source.emissiveFactor.empty() ? Rgb(0) : to_rgb(source.emissiveFactor);
    material.emission = strength * factor;
    if (material.emissive())
        material.emission_texture = use(source.emissiveTexture, true, place + ".emissiveTexture");
}

void GltfMaterials::read_gloss(const tinygltf::Material& source, const std::string& place,
                               Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Gloss& gloss = material.gloss;
    gloss.model = GlossModel::metallic_roughness;
    gloss.metallic = static_cast<float>(pbr.metallicFactor);
    gloss.roughness = static_cast<float>(pbr.roughnessFactor);
    gloss.metallic_roughness = use(pbr.metallicRoughnessTexture, false,
                                   place + ".pbrMetallicRoughness.metallicRoughnessTexture");
    gloss.ior = number(source.extensions, "KHR_materials_ior", "ior", gloss.ior);
    gloss.specular_factor = number(source.extensions, "KHR_materials_specular", "specularFactor",
                                   gloss.specular_factor);
    gloss.specular_color = numbers(source.extensions, "KHR_materials_specular",
                                   "specularColorFactor", gloss.specular_color);
    gloss.transmission = number(source.extensions, "KHR_materials_transmission",
                                "transmissionFactor", gloss.transmission);
    constexpr std::pair<const char*, const char*> kUnread[] = {
        {"KHR_materials_transmission", "transmissionTexture"},
        {"KHR_materials_specular", "specularTexture"},
        {"KHR_materials_specular", "specularColorTexture"}};
    for (const auto& [extension, member] : kUnread)
        if (extension_map_.empty() && find(source.extensions, extension, member) != nullptr)
            extension_map_ = place + ".extensions." + extension + "." + member;
    gloss.thin = !(number(source.extensions, "KHR_materials_volume", "thicknessFactor", 0) > 0);
}

TextureUse GltfMaterials::use(const tinygltf::TextureInfo& info, bool srgb,
                              const std::string& place) {
    TextureUse use;
    if (info.index < 0) return use;
    constexpr const char* kTransform = "KHR_texture_transform";
    const Value* texcoord = find(info.extensions, kTransform, "texCoord");
    const int uv_set = texcoord == nullptr ? info.texCoord : texcoord->GetNumberAsInt();
    if (uv_set < 0 || uv_set > 1)
        throw Error(place, fmt::format("TEXCOORD_{} is not supported; only 0 and 1 are", uv_set));
    use.uv_set = static_cast<std::uint8_t>(uv_set);
    use.offset = numbers(info.extensions, kTransform, "offset", use.offset);
    use.scale = numbers(info.extensions, kTransform, "scale", use.scale);
    use.rotation = number(info.extensions, kTransform, "rotation", use.rotation);
    use.texture = texture(info.index, srgb);
    return use;
}

TextureId GltfMaterials::texture(int index, bool srgb) {
    const tinygltf::Texture& source = document_.model().textures[static_cast<std::size_t>(index)];
    const std::string place = document_.where(fmt::format("textures[{}]", index));
    if (source.source < 0) throw Error(place, "has no image of a kind that can be read");
    const auto [known, fresh] =
        textures_.try_emplace({source.source, source.sampler, srgb}, TextureId::none);
    if (!fresh) return known->second;

    const auto image = static_cast<std::size_t>(source.source);
    const std::string image_place = document_.where(fmt::format("images[{}]", image));
    Texture texture = read_texture(document_.image_bytes(image, image_place), image_place);
    texture.name = !source.name.empty() ? source.name : document_.images()[image].name;
    texture.srgb = srgb;
    if (source.sampler >= 0) {
        const tinygltf::Sampler& sampler =
            document_.model().samplers[static_cast<std::size_t>(source.sampler)];
        const std::string where = document_.where(fmt::format("samplers[{}]", source.sampler));
        texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        texture.wrap_u = wrap_mode(sampler.wrapS, where + ".wrapS");
        texture.wrap_v = wrap_mode(sampler.wrapT, where + ".wrapT");
    }
    known->second = add_texture(scene_, std::move(texture), image_place);
    return known->second;
}

void GltfMaterials::warn_of_unused_images() {
    std::set<int> used;
    for (const auto& [key, id] : textures_) used.insert(std::get<0>(key));
    for (std::size_t i = 0; i < document_.images().size(); ++i) {
        if (used.contains(static_cast<int>(i))) continue;
        const std::string missing = document_.missing_file(i);
        if (!missing.empty())
            scene_.warnings.push_back(
                document_.where(fmt::format("images[{}]: there is no file \"{}\", and no surface "
                                            "needs it",
                                            i, printable(missing))));
    }
}

}  // namespace chiaro
