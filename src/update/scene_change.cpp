#include "update/scene_change.h"

#include <algorithm>

namespace chiaro {

bool SceneChange::has_moved(ObjectId object) const {
    return std::binary_search(moved.begin(), moved.end(), object);
}

SceneChange change_of(std::span<const EditEffect> effects) {
    SceneChange change;
    for (const EditEffect& effect : effects) {
        change.lights |= effect.lights;
        change.geometry |= effect.geometry;
        change.materials |= effect.material != MaterialId::none;
        change.passing |= effect.passing;
        if (!effect.geometry || effect.object == ObjectId::none) continue;
        change.moved.push_back(effect.object);
        for (const auto& box : {effect.before, effect.after})
            if (box) change.boxes.push_back(*box);
    }
    std::sort(change.moved.begin(), change.moved.end());
    change.moved.erase(std::unique(change.moved.begin(), change.moved.end()), change.moved.end());
    if (change.boxes.size() > kMostBoxes) {
        Box all = change.boxes.front();
        for (const Box& box : change.boxes) all.add(box);
        change.boxes = {all};
    }
    return change;
}

}  // namespace chiaro
