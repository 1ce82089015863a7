#include "update/view_change.h"

namespace chiaro {

void ViewChange::add(const ViewChange& later) {
    everywhere |= later.everywhere;
    boxes.insert(boxes.end(), later.boxes.begin(), later.boxes.end());
}

ViewChange view_change_of(const SceneChange& change) {
    ViewChange seen = {change.materials, change.boxes};
    seen.boxes.insert(seen.boxes.end(), change.relit.begin(), change.relit.end());
    return seen;
}

}  // namespace chiaro
