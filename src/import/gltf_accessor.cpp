#include "import/gltf_accessor.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace chiaro {
namespace {

using tinygltf::Accessor;
using tinygltf::BufferView;
using tinygltf::Model;

const Accessor& accessor_at(const GltfDocument& document, int accessor) {
    return document.model().accessors[static_cast<std::size_t>(accessor)];
}

const BufferView& view_at(const GltfDocument& document, int view) {
    return document.model().bufferViews[static_cast<std::size_t>(view)];
}

std::uint64_t component_bytes(int component_type) {
    return static_cast<std::uint64_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

// Bytes of an element. Columns of matrices start at multiples of 4 bytes.
std::uint64_t element_bytes(const Accessor& accessor) {
    const std::uint64_t size = component_bytes(accessor.componentType);
    const auto matrix = [&](std::uint64_t side) { return side * ((side * size + 3) / 4 * 4); };
    if (accessor.type == TINYGLTF_TYPE_MAT2) return matrix(2);
    if (accessor.type == TINYGLTF_TYPE_MAT3) return matrix(3);
    return component_count(accessor) * size;
}

std::uint64_t stride_of(const GltfDocument& document, const Accessor& accessor) {
    const std::size_t stride = view_at(document, accessor.bufferView).byteStride;
    return stride > 0 ? stride : element_bytes(accessor);
}

// `count` elements of `bytes`, `stride` apart from `offset`, must lie within `length`.
void check_range(std::uint64_t offset, std::uint64_t stride, std::uint64_t count,
                 std::uint64_t bytes, std::uint64_t length, const std::string& where) {
    const bool fits = bytes <= length && offset <= length - bytes &&
                      (count - 1) <= (length - bytes - offset) / stride;
    if (!fits)
        throw Error(where, fmt::format("{} elements from byte {} reach beyond the {} bytes of its "
                                       "bufferView",
                                       count, offset, length));
}

void check_dense(const GltfDocument& document, const Accessor& accessor, const std::string& where) {
    const BufferView& view = view_at(document, accessor.bufferView);
    const std::uint64_t stride = stride_of(document, accessor);
    const std::uint64_t component = component_bytes(accessor.componentType);
    if (stride < element_bytes(accessor))
        throw Error(where, "its elements overlap: the byteStride is too small");
    if (accessor.byteOffset % component != 0 ||
        (view.byteOffset + accessor.byteOffset) % component != 0 || stride % component != 0)
        throw Error(where, "is not aligned to the size of its components");
    check_range(accessor.byteOffset, stride, accessor.count, element_bytes(accessor),
                view.byteLength, where);
}

void check_sparse(const GltfDocument& document, const Accessor& accessor,
                  const std::string& where) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::uint64_t>(sparse.count);
    if (count > accessor.count) throw Error(where, "has more sparse elements than elements");
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        throw Error(where + ".sparse.indices", "are not unsigned integers");
    const auto check_part = [&](int view, int offset, std::uint64_t bytes, const char* part) {
        check_range(static_cast<std::uint64_t>(offset), bytes, count, bytes,
                    view_at(document, view).byteLength, where + part);
        if (document.view_bytes(view).empty()) throw Error(where + part, "its buffer has no data");
    };
    check_part(sparse.indices.bufferView, sparse.indices.byteOffset, component_bytes(type),
               ".sparse.indices");
    check_part(sparse.values.bufferView, sparse.values.byteOffset, element_bytes(accessor),
               ".sparse.values");
}

template <typename T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

double load_component(const std::uint8_t* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load<std::int8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load<std::int16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load<std::uint32_t>(bytes);
        default:
            return static_cast<double>(load<float>(bytes));
    }
}

// What a normalized integer is divided by; 1 if it is not normalized.
double divisor(const Accessor& accessor) {
    if (!accessor.normalized) return 1;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 127;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 255;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 32767;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 65535;
        default:
            return 1;
    }
}

// Calls set(element, component, value) for each number of `count` packed or strided elements.
template <typename Set>
void for_each_number(const Accessor& accessor, const std::uint8_t* bytes, std::uint64_t stride,
                     std::uint64_t count, const Set& set) {
    const std::size_t components = component_count(accessor);
    const std::uint64_t size = component_bytes(accessor.componentType);
    for (std::uint64_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < components; ++c)
            set(i, c, load_component(bytes + i * stride + c * size, accessor.componentType));
}

// Calls set(element, component, value) for all numbers that the accessor has data for: first the
// dense ones, then the sparse ones that replace them. Matrices with padding are not meant to be
// read.
template <typename Set>
void for_each_number(const GltfDocument& document, int index, const Set& set) {
    const Accessor& accessor = accessor_at(document, index);
    if (accessor.bufferView >= 0) {
        const GltfBytes bytes = document.view_bytes(accessor.bufferView);
        if (!bytes.empty())
            for_each_number(accessor, bytes.data() + accessor.byteOffset,
                            stride_of(document, accessor), accessor.count, set);
    }
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    const std::uint8_t* places =
        document.view_bytes(sparse.indices.bufferView).data() + sparse.indices.byteOffset;
    const std::uint8_t* values =
        document.view_bytes(sparse.values.bufferView).data() + sparse.values.byteOffset;
    const std::uint64_t place_bytes = component_bytes(sparse.indices.componentType);
    double last = -1;
    for_each_number(
        accessor, values, element_bytes(accessor), static_cast<std::uint64_t>(sparse.count),
        [&](std::uint64_t i, std::size_t component, double value) {
            const double place =
                load_component(places + i * place_bytes, sparse.indices.componentType);
            const auto refuse = [&](const char* what) {
                throw Error(document.where(fmt::format("accessors[{}].sparse.indices", index)),
                            fmt::format("element {} {}", place, what));
            };
            if (place >= static_cast<double>(accessor.count)) refuse("is not there");
            if (component == 0 && place <= last) refuse("does not come after the one before it");
            last = place;
            set(static_cast<std::uint64_t>(place), component, value);
        });
}

// `budget` is how many numbers may still be looked at: many accessors may name the same bytes.
void check_bounds(const GltfDocument& document, int index, std::uint64_t& budget) {
    const Accessor& accessor = accessor_at(document, index);
    const std::size_t components = component_count(accessor);
    const bool has_bounds =
        accessor.minValues.size() == components && accessor.maxValues.size() == components;
    if (!has_bounds || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
        accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
        accessor.count * components > budget)
        return;
    budget -= accessor.count * components;
    for_each_number(document, index, [&](std::uint64_t i, std::size_t c, double value) {
        if (value < accessor.minValues[c] || value > accessor.maxValues[c])
            throw Error(document.where(fmt::format("accessors[{}]", index)),
                        fmt::format("element {} is not within its min and max", i));
    });
}

}  // namespace

void check_buffer_views(const GltfDocument& document) {
    const std::vector<BufferView>& views = document.model().bufferViews;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::uint64_t length =
            document.buffers()[static_cast<std::size_t>(views[i].buffer)].length;
        if (views[i].byteLength > length || views[i].byteOffset > length - views[i].byteLength)
            throw Error(document.where(fmt::format("bufferViews[{}]", i)),
                        fmt::format("{} bytes from byte {} reach beyond the {} of its buffer",
                                    views[i].byteLength, views[i].byteOffset, length));
    }
}

void check_accessors(const GltfDocument& document) {
    const std::vector<Accessor>& accessors = document.model().accessors;
    std::uint64_t zeros = 0, budget = kMostCheckedNumbers;
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        if (!document.accessor_known(i)) continue;
        const Accessor& accessor = accessors[i];
        const std::string where = document.where(fmt::format("accessors[{}]", i));
        if (accessor.bufferView >= 0) check_dense(document, accessor, where);
        if (accessor.bufferView < 0 || document.view_bytes(accessor.bufferView).empty()) {
            zeros += std::min(accessor.count, std::size_t{kMaxZeroElements} + 1);
            if (zeros > kMaxZeroElements)
                throw Error(where, "there are too many elements without data");
        }
        if (accessor.sparse.isSparse) check_sparse(document, accessor, where);
        check_bounds(document, static_cast<int>(i), budget);
    }
}

std::size_t component_count(const Accessor& accessor) {
    return static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
}

std::vector<float> read_floats(const GltfDocument& document, int index) {
    const Accessor& accessor = accessor_at(document, index);
    const std::size_t components = component_count(accessor);
    const double scale = divisor(accessor);
    std::vector<float> numbers(accessor.count * components, 0.0f);
    for_each_number(document, index, [&](std::uint64_t i, std::size_t c, double value) {
        if (!std::isfinite(value))
            throw Error(document.where(fmt::format("accessors[{}]", index)),
                        fmt::format("element {} is not finite", i));
        numbers[i * components + c] =
            static_cast<float>(scale == 1 ? value : std::max(value / scale, -1.0));
    });
    return numbers;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index) {
    std::vector<std::uint32_t> indices(accessor_at(document, index).count, 0);
    for_each_number(document, index, [&](std::uint64_t i, std::size_t, double value) {
        indices[i] = static_cast<std::uint32_t>(value);
    });
    return indices;
}

}  // namespace chiaro
