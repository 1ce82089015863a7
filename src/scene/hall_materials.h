// Materials of the built-in pool hall.
#pragma once

#include "scene/room_materials.h"

namespace chiaro {

/// What the hall has besides a room's own materials.
struct HallPalette {
    Palette room;
    MaterialId cloth, rail, leather, inlay, metal, casting, panel, paint, ceiling, floor;
    MaterialId enamel, enamel_inside, seat, cue_shaft, chalk, label;
    std::array<MaterialId, 5> bottles;
};

HallPalette make_hall_palette(Scene& scene);

}  // namespace chiaro
