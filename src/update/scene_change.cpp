#include "update/scene_change.h"

#include <algorithm>
#include <map>

namespace chiaro {

bool SceneChange::has_moved(ObjectId object) const {
    return std::binary_search(moved.begin(), moved.end(), object);
}

namespace {

// Of an object that moved: where the last cycle saw it, and where the next one will.
struct Places {
    std::optional<Box> before, after;
};

Box united(std::span<const Box> boxes) {
    Box all = boxes.front();
    for (const Box& box : boxes) all.add(box);
    return all;
}

// Of many, what is left and what is entered stay apart, so that nothing between is in them.
std::vector<Box> boxes_of(const std::map<ObjectId, Places>& moved) {
    std::vector<Box> before, after;
    for (const auto& [object, places] : moved) {
        if (places.before) before.push_back(*places.before);
        if (places.after) after.push_back(*places.after);
    }
    if (before.size() + after.size() > kMostBoxes)
        for (std::vector<Box>* boxes : {&before, &after})
            if (!boxes->empty()) *boxes = {united(*boxes)};
    before.insert(before.end(), after.begin(), after.end());
    return before;
}

}  // namespace

SceneChange change_of(std::span<const EditEffect> effects) {
    SceneChange change;
    std::map<ObjectId, Places> moved;
    for (const EditEffect& effect : effects) {
        change.lights |= effect.lights;
        change.geometry |= effect.geometry;
        change.materials |= effect.material != MaterialId::none;
        if (effect.material != MaterialId::none) change.repainted.push_back(effect.material);
        change.passing |= effect.passing;
        if (effect.object == ObjectId::none) continue;
        if (!effect.geometry) {
            if (effect.after) change.relit.push_back(*effect.after);
            continue;
        }
        const Places places = {effect.before, effect.after};
        if (const auto [known, is_new] = moved.try_emplace(effect.object, places); !is_new)
            known->second.after = effect.after;
    }
    for (const auto& [object, places] : moved) change.moved.push_back(object);
    change.boxes = boxes_of(moved);
    return change;
}

}  // namespace chiaro
