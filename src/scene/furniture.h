// The built-in room's furniture. Each function returns a mesh in metres that stands on y = 0 at the
// middle of its footprint, y up, its front towards +z; what hangs on a wall has its back in z = 0.
#pragma once

#include "scene/room_materials.h"

namespace chiaro {

// furniture.cpp: what one sits on and at, and keeps books in.
Mesh sofa(const Palette& palette);          // 2.1 x 0.9, for two, with cushions
Mesh chair(const Palette& palette);         // seat at 0.45
Mesh dining_table(const Palette& palette);  // 1.6 x 0.9, 0.74 high
Mesh coffee_table(const Palette& palette);  // 1.1 x 0.6, 0.40 high
Mesh bookshelf(const Palette& palette);     // 0.85 x 0.3, 2.0 high
inline constexpr float kShelfWidth = 0.8f;  // free, between the sides
inline constexpr int kShelfCount = 5;
float shelf_height(int shelf);  // where books stand, from the bottom

// decoration.cpp: small things, and what hangs.
Mesh book_row(const Palette& palette, int count,
              std::uint32_t seed);  // stands on y = 0, from x = 0
Mesh book_stack(const Palette& palette);
Mesh rug(const Palette& palette);  // 2.6 x 1.8, 12 mm thick
Mesh floor_lamp(const Palette& palette);
Mesh plant(const Palette& palette);
Mesh picture(const Palette& palette, int which);  // 0.56 x 0.72, hung by its middle
Mesh vase(const Palette& palette);
Mesh fruit_bowl(const Palette& palette);

}  // namespace chiaro
