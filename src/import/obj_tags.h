// Subdivision tags of OBJ files (`t crease 2/1/0 0 1 2.5`), as OpenSubdiv's own shapes have them.
#pragma once

#include "import/cage.h"
#include "import/text_lines.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace chiaro {

/// The tags of a whole file: vertices and faces count from 0 over all of it.
struct ObjTags {
    bool any = false;
    std::vector<SharpEdge> creases;
    std::vector<SharpVertex> corners;
    std::set<std::uint32_t> holes;
    SubdivisionRules rules;
    std::set<std::string> unknown;  // names of tags that were left out
};

/// Reads what follows the `t` of the line. Throws an Error at the line.
void read_tag(TextLines& lines, ObjTags& tags);

}  // namespace chiaro
