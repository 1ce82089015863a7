// Typed arrays in the buffers of a glTF document (glTF 2.0, 3.6).
#pragma once

#include "import/gltf_document.h"

#include <cstdint>
#include <vector>

namespace chiaro {

/// The most elements, in one document, of accessors that have no data and so are zeros.
inline constexpr std::uint64_t kMaxZeroElements = 1 << 20;
/// How many numbers of a document are held against the bounds of their accessors.
inline constexpr std::uint64_t kMostCheckedNumbers = 1 << 28;

/// Throws an Error at the first buffer view that reaches beyond its buffer.
void check_buffer_views(const GltfDocument& document);

/// Throws an Error at the first accessor that reaches beyond its buffer view, is not aligned to its
/// components, has more zeros than kMaxZeroElements or whose integers are not within the min and
/// max that it declares, as far as kMostCheckedNumbers goes. (Floats are rounded when they are
/// written as text: their bounds are not held against them.)
void check_accessors(const GltfDocument& document);

/// Numbers in one element: 1 for a scalar, 3 for a VEC3, 16 for a MAT4.
std::size_t component_count(const tinygltf::Accessor& accessor);

/// All elements of an accessor as floats, component_count() each; normalized integers become [0, 1]
/// or [-1, 1]. Sparse elements are in their places. Throws an Error if a number is not finite.
std::vector<float> read_floats(const GltfDocument& document, int accessor);

/// All elements of a scalar accessor of unsigned integers.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor);

}  // namespace chiaro
