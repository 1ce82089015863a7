// Cages of Catmull-Clark surfaces from the polygons of OBJ files.
#pragma once

#include "import/cage.h"
#include "import/obj_geometry.h"
#include "import/obj_tags.h"

namespace chiaro {

/// The cage of a part's faces, with the tags that concern it. Checks: all corners are in range.
Cage make_cage(const ObjGeometry& geometry, const ObjPart& part, const ObjTags& tags);

}  // namespace chiaro
