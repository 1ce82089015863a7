// What becomes of each file of a collection of bad and odd ones. The glTF files come with the
// report of the Khronos validator: those without an error are accepted, the others refused.
#pragma once

#include <filesystem>

namespace chiaro::malformed {

inline const std::filesystem::path kFolder = std::filesystem::path(CHIARO_SCENES) / "malformed";

enum class Verdict { accepted, refused };

struct Expectation {
    const char* file;
    Verdict verdict;
};

using enum Verdict;
inline constexpr Expectation kExpected[] = {
    // A face that runs round a square 234 times is that square.
    {"box_longline.obj", accepted},
    {"concave_polygon.obj", accepted},
    {"empty.obj", refused},
    {"malformed.obj", refused},       // an index of 0, and one beyond the end
    {"malformed2.obj", refused},      // a face without corners
    {"number_formats.obj", refused},  // 3.1+e2
    {"mut_obj_concave_quad.obj", accepted},
    {"mut_obj_index_oob.obj", refused},
    {"mut_obj_index_zero.obj", refused},
    {"mut_obj_nan.obj", refused},
    // Well-formed, though nothing is left of it: a scene without objects, and a warning.
    {"mut_obj_zero_area_quad.obj", accepted},

    {"integer-out-of-bounds.gltf", refused},
    {"invalid-buffer-index.gltf", refused},
    {"invalid-buffer-view-index.gltf", refused},
    {"invalid-primitive-indices.gltf", refused},
    {"mut_glb_length_4GB.glb", refused},
    {"mut_gltf_node_cycle.gltf", refused},
    {"mut_gltf_unknown_required_ext.gltf", refused},

    {"gltf_validator/base/data/accessor/alignment.gltf", refused},
    {"gltf_validator/base/data/accessor/unknown_type.gltf", accepted},
    {"gltf_validator/base/data/accessor_data/out_of_range_elements_sint8.gltf", refused},
    {"gltf_validator/base/data/animation/empty_objects.gltf", refused},
    {"gltf_validator/base/data/animation/unresolved_sampler_input.gltf", refused},
    {"gltf_validator/base/data/asset/empty_array.gltf", refused},
    {"gltf_validator/base/data/buffer/extra_padding.glb", accepted},
    {"gltf_validator/base/data/buffer/not_found.gltf", refused},
    {"gltf_validator/base/data/buffer_view/invalid_length.gltf", refused},
    {"gltf_validator/base/data/camera/empty_objects.gltf", refused},
    {"gltf_validator/base/data/glb/chunk_too_big.glb", refused},
    {"gltf_validator/base/data/glb/length_mismatch.glb", refused},
    {"gltf_validator/base/data/glb/two_empty_json_chunks.glb", refused},
    {"gltf_validator/base/data/image/buffer_view_bytestride.gltf", refused},
    {"gltf_validator/base/data/image/invalid_uri_scheme.gltf", refused},
    {"gltf_validator/base/data/json/bom.gltf", refused},
    {"gltf_validator/base/data/material/multiple_extensions.gltf", accepted},
    {"gltf_validator/base/data/mesh/accessor_unequal_count.gltf", refused},
    {"gltf_validator/base/data/mesh/invalid_attribute_escaped_name.gltf", refused},
    {"gltf_validator/base/data/mesh/position_accessor_invalid_format.gltf", refused},
    {"gltf_validator/base/data/mesh/unresolved_positions.gltf", refused},
    // The validator's errors are normals and tangents that are not of unit length. We make normals
    // unit, as many exporters need, and read no tangents.
    {"gltf_validator/base/data/mesh_data/normals_tangents_non_unit_invalid_sign.gltf", accepted},
    {"gltf_validator/base/data/node/node_loop.gltf", refused},
    {"gltf_validator/base/data/node/unresolved_camera.gltf", refused},
    {"gltf_validator/base/data/root/empty_object.gltf", refused},
    // Its buffers have no data, which glTF allows: zeros, so nothing is left of its mesh.
    {"gltf_validator/base/data/root/unused_objects.gltf", accepted},
    {"gltf_validator/base/data/scene/non_root_node.gltf", refused},
    {"gltf_validator/base/data/skin/empty_object.gltf", refused},
    {"gltf_validator/base/data/skin/unresolved_ibm.gltf", refused},
    {"gltf_validator/base/data/texture/unresolved_source.gltf", refused},

    {"gltf_validator/ext/EXT_texture_webp/data/texture/unresolved_source.gltf", refused},
    {"gltf_validator/ext/KHR_animation_pointer/data/animation/channel/target/valid.gltf", accepted},
    {"gltf_validator/ext/KHR_lights_punctual/data/light/unknown_type.gltf", accepted},
    {"gltf_validator/ext/KHR_materials_anisotropy/data/material/custom_property.gltf", accepted},
    {"gltf_validator/ext/KHR_materials_clearcoat/data/material/unexpected_extension.gltf", refused},
    {"gltf_validator/ext/KHR_materials_emissive_strength/data/material/out_of_range.gltf", refused},
    {"gltf_validator/ext/KHR_materials_iridescence/data/material/unexpected_extension.gltf",
     refused},
    {"gltf_validator/ext/KHR_materials_sheen/data/material/valid.gltf", accepted},
    {"gltf_validator/ext/KHR_materials_unlit/data/material/unexpected_extension.gltf", refused},
    {"gltf_validator/ext/KHR_materials_variants/data/variant/custom_property.gltf", accepted},
    {"gltf_validator/ext/KHR_materials_volume/data/material/unknown_transmission.gltf", accepted},
    {"gltf_validator/ext/KHR_texture_transform/data/textureInfo/unexpected_extension.gltf",
     refused},
};

}  // namespace chiaro::malformed
