// Typed indices: values stand in arrays and name each other by these, never by pointers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace chiaro {

enum class ObjectId : std::uint32_t { none = 0xffff'ffff };
enum class MeshId : std::uint32_t { none = 0xffff'ffff };
enum class MaterialId : std::uint32_t { none = 0xffff'ffff };
enum class TextureId : std::uint32_t { none = 0xffff'ffff };
enum class CameraId : std::uint32_t { none = 0xffff'ffff };
enum class NodeId : std::uint32_t { none = 0xffff'ffff };
enum class LightId : std::uint32_t { none = 0xffff'ffff };

/// The position in its array that a typed index names.
template <typename Id>
constexpr std::size_t index_of(Id id) {
    return static_cast<std::size_t>(id);
}

}  // namespace chiaro
