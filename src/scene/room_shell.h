// The built-in room without furniture: walls, joinery and lamp.
#pragma once

#include "scene/room_materials.h"

namespace chiaro {

/// Inside the walls: x from 0 to width, y up from 0 to height, z from 0 (back wall) to depth.
inline constexpr float kRoomWidth = 6.2f;  // metres
inline constexpr float kRoomHeight = 2.6f;
inline constexpr float kRoomDepth = 4.8f;

/// A wall's own frame: x along the wall, y up, z into the room, the wall in z = 0. Its origin is
/// the lower left corner as one faces the wall.
Mat4 back_wall_frame();
Mat4 right_wall_frame();
Mat4 front_wall_frame();
Mat4 left_wall_frame();

Mesh floor_mesh(const Palette& palette);
Mesh ceiling_mesh(const Palette& palette);

/// Single quads, but eight round a window (a grid without its middle, so that corners are shared).
Mesh plain_wall(MaterialId material, float width);
Mesh window_wall(MaterialId material, float width, Vec2 window_low, Vec2 window_high);

/// In the wall's frame, moved so that the opening's lower left corner is the origin.
Mesh window_mesh(const Palette& palette, Vec2 size);
Mesh curtain_mesh(const Palette& palette);  // one side, 0.5 m wide, hung from kCurtainRail
Mesh curtain_rod_mesh(const Palette& palette, float length);
inline constexpr float kCurtainRail = 2.32f;     // metres above the floor
inline constexpr float kCurtainDistance = 0.1f;  // from the wall

/// In the wall's frame, the door leaf from x = 0 to kDoorWidth; hides the skirting behind it.
Mesh door_mesh(const Palette& palette);
inline constexpr float kDoorWidth = 0.84f;

/// In a wall's frame, about x = 0: a cast-iron radiator of many columns, under a window.
Mesh radiator_mesh(const Palette& palette);

/// All round the room.
Mesh skirting_mesh(const Palette& palette);
Mesh cornice_mesh(const Palette& palette);

/// A luminous panel that hangs from y = 0, centred, and shines down.
Mesh lamp_mesh(const Palette& palette);

}  // namespace chiaro
