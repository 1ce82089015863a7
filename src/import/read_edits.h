// Edit scripts: JSON that changes a scene at given times (docs/files.md).
#pragma once

#include "import/named_edit.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace chiaro {

struct TimedEdit {
    double time = 0;    // [s]
    std::string where;  // "file: edits[3]", for messages
    NamedEdit edit;
};

struct EditScript {
    std::vector<TimedEdit> edits;  // by time; of those at one time, in the order of the file
    std::vector<double> frames;    // instants [s] of which pictures are wanted, as in the file
};

/// Throws an Error of one line, `file: where: what`, for whatever is wrong with it. Names are not
/// looked up yet (import/resolve_edits.h).
EditScript read_edits(const std::filesystem::path& file);
EditScript parse_edits(std::string_view text, const std::string& where);

}  // namespace chiaro
