// The built-in pool hall: where everything stands.

#include "scene/built_in.h"
#include "scene/decorator.h"
#include "scene/furniture.h"
#include "scene/hall_furniture.h"
#include "scene/pool_balls.h"
#include "scene/pool_table.h"
#include "scene/room_shell.h"

#include <cmath>

namespace chiaro {
namespace {

// Inside the walls, as in room_shell.h.
constexpr float kWidth = 11;
constexpr float kHeight = 3.3f;
constexpr float kDepth = 8.4f;

constexpr float kTableX[] = {2.35f, 5.5f, 8.65f};
constexpr float kTableZ = 4.95f;
constexpr float kBarX = 5.5f;
constexpr float kBarZ = 1.55f;
constexpr float kBarLength = 4.6f;

// An 800 lm bulb above each third of a table and over the bar.
constexpr float kTableBulb = 800 / (4 * kPi);  // cd
constexpr float kBarBulb = 700 / (4 * kPi);
constexpr Rgb kWarmWhite = {1.13f, 0.985f, 0.75f};  // of luminance 1

Mat4 wall_frame(int wall) {
    switch (wall) {
        case 0:
            return Mat4(1);  // back
        case 1:
            return moved({kWidth, 0, 0}) * turned({0, 1, 0}, -90);
        case 2:
            return moved({kWidth, 0, kDepth}) * turned({0, 1, 0}, 180);
        default:
            return moved({0, 0, kDepth}) * turned({0, 1, 0}, 90);  // left
    }
}

void add_shell(Decorator& hall, const HallPalette& palette) {
    const auto rectangle = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d, MaterialId material) {
        Mesh mesh;
        add(mesh, quad(a, b, c, d), material);
        return mesh;
    };
    const float x = kWidth, y = kHeight, z = kDepth;
    hall.place("Floor", rectangle({0, 0, z}, {x, 0, z}, {x, 0, 0}, {0, 0, 0}, palette.floor));
    hall.place("Ceiling", rectangle({0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}, palette.ceiling));
    const char* names[] = {"Back", "Right", "Front", "Left"};
    for (int wall = 0; wall < 4; ++wall) {
        const float width = wall % 2 == 0 ? x : z;
        const std::string name = names[wall];
        hall.place(name + " wall",
                   rectangle({0, 0, 0}, {width, 0, 0}, {width, y, 0}, {0, y, 0}, palette.paint),
                   wall_frame(wall));
        hall.place(name + " panelling", wainscot(palette, width), wall_frame(wall));
    }
    const MeshId beam = hall.mesh("Beam", [&] {
        Mesh mesh;
        add(mesh, box({0, y - 0.22f, -0.1f}, {x, y, 0.1f}, kTop | kLeft | kRight), palette.panel);
        return mesh;
    }());
    for (int i = 0; i < 4; ++i)
        hall.place("Beam " + std::to_string(i + 1), beam,
                   moved({0, 0, 1.05f + 2.1f * static_cast<float>(i)}));
}

// A lamp is a shade and the bulb inside.
void add_lamps(Decorator& hall, Scene& scene, const HallPalette& palette) {
    constexpr float kBulbHeight = 1.8f;
    constexpr float kApart = 0.85f;
    const MeshId over_table = hall.mesh("Table lamp", pendant(palette, kHeight - kBulbHeight));
    const auto add_lamp = [&](MeshId shade, Vec3 bulb, float candela) {
        const std::string name = "Lamp " + std::to_string(scene.lights.size() + 1);
        hall.place(name, shade, moved(bulb));
        scene.lights.push_back({.name = name, .intensity = candela * kWarmWhite, .position = bulb});
    };
    for (const float x : kTableX)
        for (const float z : {-kApart, 0.0f, kApart})
            add_lamp(over_table, {x, kBulbHeight, kTableZ + z}, kTableBulb);

    constexpr float kBarBulbHeight = 2.45f;
    const MeshId over_bar = hall.mesh("Bar lamp", pendant(palette, kHeight - kBarBulbHeight));
    for (const float x : {-1.1f, 1.1f})
        add_lamp(over_bar, {kBarX + x, kBarBulbHeight, kBarZ - 0.25f}, kBarBulb);
}

// A game in progress on the middle table: the cue ball and fourteen that are left.
void add_game(Decorator& hall, Scene& scene, const HallPalette& palette) {
    struct Lie {
        int number;
        Vec2 place;  // on the cloth, across and along
        Vec3 axis;
        float turn;
    };
    constexpr Lie kLies[] = {{0, {0.15f, 0.76f}, {0, 1, 0}, 0},
                             {1, {-0.03f, 0.3f}, {0, 1, 0.2f}, -60},
                             {2, {0.09f, 0.17f}, {0.3f, 1, 0}, -95},
                             {3, {-0.12f, 0.15f}, {0, 1, 0.4f}, -120},
                             {4, {0.03f, 0.08f}, {0.2f, 1, 0.1f}, -75},
                             {5, {-0.075f, 0.06f}, {0, 1, -0.3f}, -40},
                             {6, {0.145f, 0.05f}, {0.5f, 1, 0}, -110},
                             {7, {-0.27f, 0.36f}, {0, 1, 0.3f}, -85},
                             {8, {0, 0.005f}, {0.1f, 1, 0.3f}, -70},
                             {9, {-0.31f, -0.24f}, {0.3f, 1, 0.5f}, -100},
                             {10, {0.36f, 0.5f}, {0.4f, 1, 0.6f}, -80},
                             {11, {0.42f, -0.38f}, {0.6f, 1, 0.2f}, -50},
                             {12, {-0.44f, 0.02f}, {0.5f, 1, -0.4f}, -90},
                             {13, {0.075f, -0.065f}, {-0.5f, 1, 0.4f}, -115},
                             {14, {-0.13f, -0.09f}, {0.6f, 1, 0.5f}, -65}};
    const Vec3 middle(kTableX[1], kClothHeight + kBallRadius, kTableZ);
    for (const Lie& lie : kLies) {
        const std::string name =
            lie.number == 0 ? "Cue ball" : "Ball " + std::to_string(lie.number);
        hall.place(name, pool_ball(scene, lie.number),
                   moved(middle + Vec3(lie.place.x, 0, lie.place.y)) * turned(lie.axis, lie.turn));
    }
    // A cue lies on the cloth and the rail; its weight is inside.
    const MeshId stick = hall.mesh("Cue", cue(palette));
    const Vec3 tip = Vec3(kTableX[1] + 0.27f, kClothHeight + 0.007f, kTableZ + 0.3f);
    const Vec3 butt = tip + 1.47f * glm::normalize(Vec3(0.1f, 0.0475f, 1));
    const Vec3 along = glm::normalize(tip - butt);
    hall.place(
        "Cue 1", stick,
        moved(butt) * turned(glm::cross(Vec3(0, 1, 0), along), glm::degrees(std::acos(along.y))));
    const MeshId cube = hall.mesh("Chalk", chalk(palette));
    const Vec2 cubes[] = {{0.735f, 0.72f}, {-0.28f, -1.36f}};
    for (int i = 0; i < 2; ++i)
        hall.place("Chalk " + std::to_string(i + 1), cube,
                   standing(kTableX[1] + cubes[i].x, kTableZ + cubes[i].y,
                            35 * static_cast<float>(i + 1), kRailHeight + 0.0003f));
}

void add_tables(Decorator& hall, const HallPalette& palette) {
    const MeshId table = hall.mesh("Pool table", pool_table(palette));
    for (int i = 0; i < 3; ++i)
        hall.place("Pool table " + std::to_string(i + 1), table, standing(kTableX[i], kTableZ));
    hall.place("Ball rack", ball_rack(palette),
               standing(kTableX[0] + 0.1f, kTableZ + 0.5f, 25, kClothHeight + 0.0005f));
}

void add_bar(Decorator& hall, const HallPalette& palette) {
    hall.place("Bar", bar_counter(palette, kBarLength), standing(kBarX, kBarZ));
    const Mat4 behind = moved({kBarX, 0, 0.06f});
    hall.place("Back bar", back_bar(palette, kBarLength - 0.4f), behind);

    std::vector<MeshId> kinds;
    for (int i = 0; i < 5; ++i)
        kinds.push_back(
            hall.mesh("Bottle " + std::to_string(i + 1),
                      bottle(palette.bottles[i], i % 2 == 0 ? palette.inlay : palette.cue_shaft,
                             0.27f + 0.015f * static_cast<float>(i % 3))));
    constexpr int kOnShelf = 9;
    for (int shelf = 0; shelf < kBackBarShelves; ++shelf)
        for (int i = 0; i < kOnShelf; ++i) {
            const int number = kOnShelf * shelf + i;
            const float x = 0.4f * (static_cast<float>(i) - 0.5f * (kOnShelf - 1)) +
                            0.11f * std::sin(5.0f * static_cast<float>(number));
            hall.place("Bottle " + std::to_string(number + 1),
                       kinds[static_cast<std::size_t>((3 * number + shelf) % 5)],
                       behind * standing(x, 0.15f, 0, back_bar_shelf(shelf) + 0.0005f));
        }

    const MeshId stool = hall.mesh("Stool", bar_stool(palette));
    for (int i = 0; i < 5; ++i)
        hall.place("Stool " + std::to_string(i + 1), stool,
                   standing(kBarX - 1.8f + 0.9f * static_cast<float>(i), kBarZ + 0.62f,
                            11 * static_cast<float>(i)));
}

void hang_on_walls(Decorator& hall, const HallPalette& palette) {
    constexpr int kCues = 6;
    const Mat4 rack = wall_frame(1) * moved({5.2f, 0.35f, 0.056f});
    hall.place("Cue rack", cue_rack(palette, kCues), rack);
    const MeshId stick = hall.mesh("Standing cue", cue(palette));
    for (int i = 0; i < kCues; ++i)
        hall.place("Cue " + std::to_string(i + 2), stick,
                   rack * moved({kCuePitch * (static_cast<float>(i) - 0.5f * (kCues - 1)),
                                 kCueFoot + 0.0005f, kCueDepth}));

    struct Hanging {
        int wall;
        Vec2 place;
    };
    constexpr Hanging kPictures[] = {{0, {1.0f, 1.9f}}, {0, {1.85f, 1.9f}}, {0, {2.7f, 1.9f}},
                                     {0, {8.6f, 1.9f}}, {0, {9.5f, 1.9f}},  {1, {1.6f, 1.9f}},
                                     {1, {2.6f, 1.9f}}, {1, {3.6f, 1.9f}},  {3, {2.5f, 1.9f}},
                                     {3, {4.2f, 1.9f}}, {3, {5.9f, 1.9f}}};
    int number = 0;
    for (const Hanging& hanging : kPictures) {
        hall.place("Picture " + std::to_string(number + 1), picture(palette.room, number % 3),
                   wall_frame(hanging.wall) * moved(Vec3(hanging.place, 0)));
        ++number;
    }
    hall.place("Door", door_mesh(palette.room), wall_frame(3) * moved({7.0f, 0, 0.056f}));
}

}  // namespace

Scene make_poolhall() {
    Scene scene;
    const HallPalette palette = make_hall_palette(scene);
    Decorator hall(scene);
    add_shell(hall, palette);
    add_lamps(hall, scene, palette);
    add_tables(hall, palette);
    add_game(hall, scene, palette);
    add_bar(hall, palette);
    hang_on_walls(hall, palette);
    scene.cameras = {{.name = "main",
                      .eye = {6.1f, 1.27f, 6.8f},
                      .target = {5.36f, 0.89f, 4.7f},
                      .vertical_fov = 52},
                     {.name = "balls",
                      .eye = {5.15f, 1.08f, 6.0f},
                      .target = {5.5f, 0.77f, 5.1f},
                      .vertical_fov = 42},
                     {.name = "bar",
                      .eye = {3.9f, 1.6f, 4.0f},
                      .target = {5.6f, 1.25f, 0.6f},
                      .vertical_fov = 60}};
    check_scene(scene);
    return scene;
}

}  // namespace chiaro
