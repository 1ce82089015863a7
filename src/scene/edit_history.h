// Undo and redo.
#pragma once

#include "scene/edit.h"

#include <functional>
#include <vector>

namespace chiaro {

/// Steps of edits that can be taken back and made again. Its owner applies edits, here as at first,
/// so that whoever follows them sees each of them once.
class EditHistory {
public:
    /// Applies an edit and returns its inverse, as apply() does.
    using Apply = std::function<Edit(const Edit&)>;

    /// Notes an edit that was made, by its inverse. `same_step`: it belongs to the step before, as
    /// while something is dragged. What had been undone cannot be redone any more.
    void add(Edit inverse, bool same_step = false);

    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }

    /// Takes the last step back, or makes it again, edit by edit; does nothing if there is none.
    void undo(const Apply& apply) { move(undo_, redo_, apply); }
    void redo(const Apply& apply) { move(redo_, undo_, apply); }

private:
    using Step = std::vector<Edit>;  // inverses, in the order in which edits were made
    static void move(std::vector<Step>& from, std::vector<Step>& to, const Apply& apply);

    std::vector<Step> undo_, redo_;
};

}  // namespace chiaro
