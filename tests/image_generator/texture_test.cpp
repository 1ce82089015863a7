// Textures finer than a pixel become their mean.
#include "image_generator/looking.h"
#include "scene/bisect_edges.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// A wall in z = 0 with a checkerboard, black and white, of `cells` on 20 units. It is not symmetric
// about the view's axis, so that no ray meets its diagonal exactly.
Scene checkerboard(float cells) {
    Scene scene;
    Texture texture;
    texture.width = texture.height = 2;
    const std::array<std::uint8_t, 4> black = {0, 0, 0, 255}, white = {255, 255, 255, 255};
    texture.texels = {black, white, white, black};
    texture.nearest = true;
    scene.textures.push_back(texture);
    const MaterialId material = add_material(scene, Rgb(1));
    scene.materials[0].base_color_texture.texture = TextureId{0};
    Mesh mesh;
    mesh.positions = {{-10, -9.3f, 0}, {10, -9.3f, 0}, {10, 12.1f, 0}, {-10, 12.1f, 0}};
    for (const Vec3 p : mesh.positions) mesh.uvs[0].push_back(cells / 40 * Vec2(p));
    mesh.primitives = {quad(0, 1, 2, 3, material)};
    add_object(scene, std::move(mesh));
    return scene;
}

// A pixel is 0.5 wide and begins where a cell does. Two cells of 0.25 across and down: two white
// ones of four, so 1/2.
TEST(TextureMean, ACheckerboardWithinAPixelIsGrey) {
    Looking l(checkerboard(80), 16, 16);
    const IdMap map = l.map(Aov::radiance);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(kPi * covered(map, x, y).g, 0.5f, 1e-4f) << x << ' ' << y;
}

// Cells of any size average out over the picture. Nothing here is random; were 48 x 48 pixels 0 or
// 1 by chance, the standard deviation of their mean would be 0.01: bound 5 of these, false alarm
// 2e-6 over four sizes.
TEST(TextureMean, APictureOfAFineCheckerboardIsGrey) {
    for (const float cells : {37.3f, 61.7f, 143.1f, 411.9f}) {
        Looking l(checkerboard(cells), 48, 48);
        const IdMap map = l.map(Aov::radiance);
        double sum = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) sum += kPi * covered(map, x, y).g;
        EXPECT_NEAR(sum / (48 * 48), 0.5, 0.05) << cells;
    }
}

// Cells much larger than a pixel keep their colours: inside a cell black or white. Cells are 5
// wide, a pixel 0.5.
TEST(TextureMean, ACoarseCheckerboardKeepsItsColours) {
    Looking l(checkerboard(4), 16, 16);
    const IdMap map = l.map(Aov::radiance);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool left = x < 8, top = y < 8;  // the middle of the wall is a cell's corner
            const float white = kPi * covered(map, x, y).g;
            EXPECT_NEAR(white,
                        left == top ? kPi * covered(map, 0, 0).g : 1 - kPi * covered(map, 0, 0).g,
                        1e-4f);
        }
}

// Of a wall in triangles smaller than a pixel each pixel shows at most one, and the mean of all
// that it covers: the same picture as of the wall in one piece. The quad's halves differ by
// rounding.
TEST(TextureMean, SmallTrianglesAreAveragedOverAsOneWall) {
    Looking whole(checkerboard(61.7f), 32, 32);
    Scene scene = checkerboard(61.7f);
    bisect_edges(scene, 0.2f);
    Looking divided(std::move(scene), 32, 32);
    const IdMap expected = whole.map(Aov::radiance), map = divided.map(Aov::radiance);
    EXPECT_LE(map.fragments.size(), 32u * 32u);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_NEAR(kPi * covered(map, x, y).g, kPi * covered(expected, x, y).g, 1e-4f);
}

// Irradiance does not ask for the surface's colour.
TEST(TextureMean, IrradianceLeavesTheTextureOut) {
    Looking l(checkerboard(80), 16, 16);
    const IdMap map = l.map(Aov::irradiance);
    for (int x = 0; x < 16; ++x) EXPECT_EQ(covered(map, x, 8), Rgb(1));
}

}  // namespace
}  // namespace chiaro
