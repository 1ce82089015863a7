// The built-in room: where everything stands.

#include "scene/built_in.h"
#include "scene/decorator.h"
#include "scene/furniture.h"
#include "scene/room_shell.h"
#include "scene/tea_set.h"

namespace chiaro {
namespace {

constexpr float kLampLuminance = 2900;  // cd/m2: about 300 lux on the free floor

void add_shell(Decorator& room, const Palette& palette) {
    // The window and the door share the right wall.
    constexpr Vec2 kWindowLow(2.75f, 0.85f);
    constexpr Vec2 kWindowHigh(4.15f, 2.15f);
    constexpr float kDoorFrom = 1.25f;
    const Mat4 right = right_wall_frame();

    room.place("Floor", floor_mesh(palette));
    room.place("Ceiling", ceiling_mesh(palette));
    room.place("Back wall", plain_wall(palette.accent_wall, kRoomWidth), back_wall_frame());
    room.place("Front wall", plain_wall(palette.wall, kRoomWidth), front_wall_frame());
    room.place("Left wall", plain_wall(palette.wall, kRoomDepth), left_wall_frame());
    room.place("Right wall", window_wall(palette.wall, kRoomDepth, kWindowLow, kWindowHigh), right);
    room.place("Skirting", skirting_mesh(palette));
    room.place("Cornice", cornice_mesh(palette));
    room.place("Door", door_mesh(palette), right * moved({kDoorFrom, 0, 0}));
    room.place("Window", window_mesh(palette, kWindowHigh - kWindowLow),
               right * moved(Vec3(kWindowLow, 0)));

    const float middle = 0.5f * (kWindowLow.x + kWindowHigh.x);
    const Mat4 rail = right * moved({middle, 0, kCurtainDistance});
    const MeshId curtain = room.mesh("Curtain", curtain_mesh(palette));
    room.place("Curtain 1", curtain, rail * moved({-1.06f, 0, 0}));
    room.place("Curtain 2", curtain, rail * moved({0.56f, 0, 0}));
    room.place("Radiator", radiator_mesh(palette), right * moved({middle, 0, 0}));
    room.place("Curtain rod", curtain_rod_mesh(palette, 2.2f), rail * moved({0, kCurtainRail, 0}));
    room.place("Ceiling lamp", lamp_mesh(palette), moved({3.1f, kRoomHeight, 2.3f}));
}

void add_sitting_corner(Decorator& room, const Palette& palette) {
    constexpr float kOnRug = 0.0125f;
    constexpr float kOnTable = kOnRug + 0.4f;
    room.place("Sofa", sofa(palette), standing(2.6f, 0.52f));
    room.place("Rug", rug(palette), standing(2.6f, 1.95f));
    room.place("Coffee table", coffee_table(palette), standing(2.6f, 1.75f, 0, kOnRug));
    room.place("Vase", vase(palette), standing(2.93f, 1.68f, 0, kOnTable));
    room.place("Book stack", book_stack(palette), standing(2.37f, 1.78f, 0, kOnTable));
    room.place("Floor lamp", floor_lamp(palette), standing(1.2f, 0.45f, 25));
    for (int i = 0; i < 3; ++i)
        room.place("Picture " + std::to_string(i + 1), picture(palette, i),
                   moved({1.86f + 0.74f * static_cast<float>(i), 1.56f, 0}));
}

void add_library(Decorator& room, const Palette& palette) {
    constexpr float kX = 4.5f;
    constexpr float kZ = 0.165f;
    room.place("Bookshelf", bookshelf(palette), standing(kX, kZ));
    const int counts[kShelfCount] = {12, 9, 14, 10, 7};
    for (int shelf = 0; shelf < kShelfCount; ++shelf)
        room.place("Books " + std::to_string(shelf + 1),
                   book_row(palette, counts[shelf], 20 + static_cast<std::uint32_t>(shelf)),
                   moved({kX - 0.5f * kShelfWidth, shelf_height(shelf), kZ + 0.12f}));
    room.place("Plant", plant(palette), standing(5.62f, 0.6f));
}

// Tea for two; y = 0 is the table.
void add_tea(Decorator& room, const Palette& palette, const Mat4& table) {
    const MeshId cup = room.mesh("Cup", teacup(palette.porcelain));
    const MeshId plate = room.mesh("Saucer", saucer(palette.porcelain));
    const Mat4 places[] = {standing(-0.24f, 0.2f, 25), standing(0.1f, 0.24f, -40)};
    for (int i = 0; i < 2; ++i) {
        const std::string number = std::to_string(i + 1);
        room.place("Saucer " + number, plate, table * places[i]);
        room.place("Cup " + number, cup, table * places[i] * moved({0, kSaucerWell, 0}));
    }
    room.place("Spoon", teaspoon(palette.silver), table * standing(-0.09f, 0.27f, 62, 0.0003f));
    room.place("Teapot", teapot(palette.porcelain), table * standing(-0.06f, -0.02f, 28, 0.0003f));
}

void add_dining_corner(Decorator& room, const Palette& palette) {
    constexpr float kX = 4.6f;
    constexpr float kZ = 3.2f;
    constexpr float kOnTable = 0.74f;
    room.place("Table", dining_table(palette), standing(kX, kZ));
    room.place("Fruit bowl", fruit_bowl(palette), standing(kX + 0.33f, kZ - 0.12f, 0, kOnTable));
    add_tea(room, palette, moved({kX - 0.2f, kOnTable, kZ}));
    const MeshId mesh = room.mesh("Chair", chair(palette));
    room.place("Chair 1", mesh, standing(kX - 0.37f, kZ - 0.56f, 4));
    room.place("Chair 2", mesh, standing(kX + 0.38f, kZ - 0.53f, -3));
    room.place("Chair 3", mesh, standing(kX - 0.42f, kZ + 0.66f, 163));
    room.place("Chair 4", mesh, standing(kX + 0.38f, kZ + 0.54f, 182));
}

}  // namespace

Scene make_room() {
    Scene scene;
    const Palette palette = make_palette(scene, kLampLuminance);
    Decorator room(scene);
    add_shell(room, palette);
    add_sitting_corner(room, palette);
    add_library(room, palette);
    add_dining_corner(room, palette);
    scene.cameras = {{.name = "main",
                      .eye = {0.35f, 1.6f, 4.5f},
                      .target = {3.45f, 0.85f, 1.6f},
                      .vertical_fov = 60},
                     {.name = "table",
                      .eye = {2.7f, 1.45f, 4.3f},
                      .target = {4.5f, 0.7f, 2.9f},
                      .vertical_fov = 50},
                     {.name = "tea",
                      .eye = {3.95f, 1.12f, 4.02f},
                      .target = {4.42f, 0.78f, 3.2f},
                      .vertical_fov = 40}};
    check_scene(scene);
    return scene;
}

}  // namespace chiaro
