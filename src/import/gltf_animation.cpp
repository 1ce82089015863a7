#include "import/gltf_animation.h"

#include "import/fault.h"
#include "import/gltf_accessor.h"
#include "import/unique_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace chiaro {
namespace {

using Json = nlohmann::json;

// Numbers in the keys of all animations: samplers may share an accessor, and each has a copy.
constexpr std::size_t kMostNumbers = std::size_t{1} << 26;

// The largest translation and scale, as of other coordinates.
constexpr float kMostValue = 1e9f;

std::optional<AnimatedPart> part_of(std::string_view path) {
    if (path == "translation") return AnimatedPart::translation;
    if (path == "rotation") return AnimatedPart::rotation;
    if (path == "scale") return AnimatedPart::scale;
    return std::nullopt;
}

class AnimationReader {
public:
    AnimationReader(const GltfDocument& document, const std::vector<NodeId>& nodes, Scene& scene)
        : document_(document), nodes_(nodes), scene_(scene) {}

    void read() {
        for (std::size_t i = 0; i < document_.animations().size(); ++i) {
            const std::string place = document_.where(fmt::format("animations[{}]", i));
            Animation animation = read_one(document_.animations()[i], place);
            if (!animation.channels.empty()) scene_.animations.push_back(std::move(animation));
        }
        for (const std::string& what : left_out_)
            scene_.warnings.push_back(document_.where("animations") + ": " + what +
                                      " not supported and left out");
    }

private:
    Animation read_one(const Json& source, const std::string& place) {
        Animation animation;
        animation.name = name_(source.value("name", ""), "animation");
        const Json& channels = source["channels"];
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const std::string where = fmt::format("{}.channels[{}]", place, i);
            const Json& target = channels[i]["target"];
            const auto path = target["path"].get<std::string>();
            const auto part = part_of(path);
            if (!part) {
                left_out_.insert(path == "weights"
                                     ? "weights of morph targets are"
                                     : fmt::format("the path \"{}\" is", printable(path)));
                continue;
            }
            const auto node = animated_node(target, where);
            if (!node) continue;
            const auto sampler = channels[i]["sampler"].get<std::size_t>();
            AnimationChannel channel = read_sampler(source["samplers"][sampler], *part,
                                                    fmt::format("{}.samplers[{}]", place, sampler));
            channel.node = *node;
            animation.duration = std::max(animation.duration, channel.times.back());
            animation.channels.push_back(std::move(channel));
        }
        return animation;
    }

    std::optional<NodeId> animated_node(const Json& target, const std::string& where) const {
        if (!target.contains("node")) return std::nullopt;  // of an extension
        const NodeId node = nodes_[target["node"].get<std::size_t>()];
        if (node == NodeId::none) return std::nullopt;
        if (!std::holds_alternative<Pose>(scene_.nodes[index_of(node)].to_parent))
            throw Error(where, "animates a node that has a matrix");
        return node;
    }

    AnimationChannel read_sampler(const Json& sampler, AnimatedPart part,
                                  const std::string& where) {
        AnimationChannel channel;
        channel.part = part;
        channel.interpolation = interpolation_of(sampler, where);
        channel.times = read_times(sampler["input"].get<int>(), where + ".input");
        const bool cubic = channel.interpolation == Interpolation::cubic;
        channel.values = read_values(sampler["output"].get<int>(), part,
                                     channel.times.size() * (cubic ? 3 : 1), where + ".output");
        // Tangents may be anything, zero too.
        const std::size_t step = cubic ? 3 : 1;
        for (std::size_t i = step / 2; i < channel.values.size(); i += step)
            check_value(channel.values[i], part, where + ".output");
        return channel;
    }

    static Interpolation interpolation_of(const Json& sampler, const std::string& where) {
        const auto name = sampler.value("interpolation", "LINEAR");
        if (name == "STEP") return Interpolation::step;
        if (name == "LINEAR") return Interpolation::linear;
        if (name == "CUBICSPLINE") return Interpolation::cubic;
        throw Error(where + ".interpolation", "is none of STEP, LINEAR and CUBICSPLINE");
    }

    std::vector<float> read_times(int index, const std::string& where) {
        const tinygltf::Accessor& accessor = accessor_at(index, where);
        if (accessor.type != TINYGLTF_TYPE_SCALAR ||
            accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            throw Error(where, "times are not scalars of floats");
        count(accessor, where);
        std::vector<float> times = read_floats(document_, index);
        if (times.front() < 0) throw Error(where, "a time is below 0");
        const auto rises = [](float a, float b) { return a < b; };
        if (std::ranges::adjacent_find(times, std::not_fn(rises)) != times.end())
            throw Error(where, "times do not rise");
        return times;
    }

    std::vector<Vec4> read_values(int index, AnimatedPart part, std::size_t wanted,
                                  const std::string& where) {
        const tinygltf::Accessor& accessor = accessor_at(index, where);
        const bool rotation = part == AnimatedPart::rotation;
        const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        if (accessor.type != (rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3))
            throw Error(where, rotation ? "rotations are not VEC4" : "values are not VEC3");
        const bool small = accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (!is_float && !(rotation && accessor.normalized && small))
            throw Error(where, rotation ? "rotations are neither floats nor normalized integers"
                                        : "values are not floats");
        if (accessor.count != wanted)
            throw Error(where, fmt::format("has {} values where the times ask for {}",
                                           accessor.count, wanted));
        count(accessor, where);
        const std::vector<float> numbers = read_floats(document_, index);
        const std::size_t components = rotation ? 4 : 3;
        std::vector<Vec4> values(wanted, Vec4(0));
        for (std::size_t i = 0; i < numbers.size(); ++i)
            values[i / components][static_cast<int>(i % components)] = numbers[i];
        return values;
    }

    static void check_value(Vec4 value, AnimatedPart part, const std::string& where) {
        if (part == AnimatedPart::rotation && !(glm::length(value) > 0))
            throw Error(where, "a rotation has no direction");
        for (int i = 0; i < 3; ++i)
            if (std::abs(value[i]) > kMostValue) throw Error(where, "has values beyond 1e9");
    }

    const tinygltf::Accessor& accessor_at(int index, const std::string& where) const {
        const auto i = static_cast<std::size_t>(index);
        if (!document_.accessor_known(i)) throw Error(where, "its accessor is of an unknown type");
        return document_.model().accessors[i];
    }

    void count(const tinygltf::Accessor& accessor, const std::string& where) {
        const std::size_t components = component_count(accessor);
        if (accessor.count > (kMostNumbers - numbers_) / components)
            throw Error(where, "the animations have too many keys");
        numbers_ += accessor.count * components;
    }

    const GltfDocument& document_;
    const std::vector<NodeId>& nodes_;
    Scene& scene_;
    UniqueNames name_;
    std::set<std::string> left_out_;
    std::size_t numbers_ = 0;
};

}  // namespace

void read_animations(const GltfDocument& document, const std::vector<NodeId>& nodes, Scene& scene) {
    AnimationReader(document, nodes, scene).read();
}

}  // namespace chiaro
