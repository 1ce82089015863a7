#include "scene/edit_history.h"

#include <algorithm>

namespace chiaro {
namespace {

// What an edit sets: two of one kind with the same target set the same thing.
std::size_t target_of(const Edit& edit) {
    struct Target {
        std::size_t operator()(const SetTransform& e) const { return index_of(e.object); }
        std::size_t operator()(const SetShown& e) const { return index_of(e.object); }
        std::size_t operator()(const SetEmission& e) const { return index_of(e.object); }
        std::size_t operator()(const SetLight& e) const { return index_of(e.light); }
        std::size_t operator()(const SetMaterial& e) const { return index_of(e.material); }
        std::size_t operator()(const SetCamera&) const { return 0; }
        std::size_t operator()(const AddObject&) const { return 0; }
        std::size_t operator()(const AddLight&) const { return 0; }
    };
    return std::visit(Target{}, edit);
}

}  // namespace

void EditHistory::add(Edit inverse, bool same_step) {
    redo_.clear();
    if (!same_step || undo_.empty()) undo_.emplace_back();
    Step& step = undo_.back();
    // The first inverse goes back to before the step, whatever came in between. (An addition is
    // never an inverse.)
    const bool known = std::ranges::any_of(step, [&](const Edit& other) {
        return other.index() == inverse.index() && target_of(other) == target_of(inverse);
    });
    if (!known) step.push_back(std::move(inverse));
}

void EditHistory::move(std::vector<Step>& from, std::vector<Step>& to, const Apply& apply) {
    if (from.empty()) return;
    const Step step = std::move(from.back());
    from.pop_back();
    Step back;
    for (auto edit = step.rbegin(); edit != step.rend(); ++edit) back.push_back(apply(*edit));
    to.push_back(std::move(back));
}

}  // namespace chiaro
