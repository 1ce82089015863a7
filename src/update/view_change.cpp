#include "update/view_change.h"

#include <optional>
#include <unordered_map>

namespace chiaro {
namespace {

struct Places {
    std::optional<Box> before, after;
};

}  // namespace

void ViewChange::add(const ViewChange& later) {
    everywhere |= later.everywhere;
    boxes.insert(boxes.end(), later.boxes.begin(), later.boxes.end());
}

ViewChange view_change_of(std::span<const EditEffect> effects) {
    ViewChange change;
    std::unordered_map<std::size_t, Places> by_object;
    for (const EditEffect& effect : effects) {
        change.everywhere |= effect.camera || effect.material != MaterialId::none;
        if (effect.object == ObjectId::none) continue;
        const auto [known, first] = by_object.try_emplace(index_of(effect.object));
        if (first) known->second.before = effect.before;
        known->second.after = effect.after;
    }
    for (const auto& [object, places] : by_object)
        for (const auto& box : {places.before, places.after})
            if (box) change.boxes.push_back(*box);
    return change;
}

}  // namespace chiaro
