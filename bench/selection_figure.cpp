// The paper's Figure 3 from our own program: the mesh, the priority map, the samples in their
// colours, the mesh after them, and the image before and after. Runs the paper's scheme.

#include "apps/open_scene.h"
#include "base/parallel.h"
#include "base/tone_map.h"
#include "import/image_file.h"
#include "run_program.h"
#include "sample_renderer/path_renderer.h"

#include <filesystem>

namespace chiaro {
namespace {

// Leaves in greys that tell neighbours apart, with dark lines between them.
Image draw_mesh(const IdMap& map) {
    Image image(map.width, map.height);
    const auto leaf_at = [&](int x, int y) {
        const auto fragments = map.at_pixel(static_cast<std::uint32_t>(y * map.width + x));
        return fragments.empty() ? PatchId::none : fragments.front().patch;
    };
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const PatchId here = leaf_at(x, y);
            const bool border = (x + 1 < map.width && leaf_at(x + 1, y) != here) ||
                                (y + 1 < map.height && leaf_at(x, y + 1) != here);
            image.at(x, y) = here == PatchId::none ? Rgb(0) : Rgb(border ? 0.1f : 0.8f);
        }
    return image;
}

Image draw_priorities(const PriorityMap& map) {
    Image image(map.width, map.height);
    const PriorityRange range = four_sigma_range(map.patch_priorities);
    for (std::uint32_t p = 0; p < image.pixels.size(); ++p)
        if (const auto priority = map.at(p)) image.pixels[p] = Rgb(range.normalize(*priority));
    return image;
}

Image draw_samples(const Image& under, const std::vector<SelectedPixel>& samples) {
    Image image = under;
    for (Rgb& pixel : image.pixels) pixel = Rgb(0.25f * luminance(pixel));
    for (const SelectedPixel& s : samples) {
        const Rgb color = s.by == SelectedBy::priority ? Rgb(1, 0.1f, 0.1f)
                          : s.by == SelectedBy::chance ? Rgb(0.1f, 1, 0.1f)
                                                       : Rgb(1, 1, 0.1f);
        const int x = static_cast<int>(s.pixel) % image.width,
                  y = static_cast<int>(s.pixel) / image.width;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (x + dx >= 0 && x + dx < image.width && y + dy >= 0 && y + dy < image.height)
                    image.at(x + dx, y + dy) = color;
    }
    return image;
}

}  // namespace

int run(int argc, char** argv) {
    Options options;
    options.scene = "builtin:cornell";
    int cycles = 12;
    std::string folder = "out/selection";
    CLI::App app("Pictures of one cycle of sample selection.");
    add_view_options(app, options);
    app.add_option("--cycles", cycles, "of the paper's scheme before the one that is shown");
    app.add_option("--folder", folder, "where the pictures go");
    CLI11_PARSE(app, argc, argv);

    Scene scene = open_scene(options);
    const PictureSize size = parse_size(options.size);
    RayCaster rays(scene, 1);
    const AreaLights area_lights(scene);
    OpenSides open_sides(scene);
    UpdateSettings settings;
    settings.scheme = Scheme::paper;
    settings.threads = hardware_threads();
    settings.fixed_size = true;
    const MeshGraphs graphs(scene, coarser_levels(settings.scheme), settings.threads);
    PathRenderer renderer(scene, rays, area_lights, &open_sides, settings.threads);
    UpdateCycle cycle(rays, graphs, renderer, open_sides, settings);
    cycle.look_from(View(choose_camera(scene, options), size.width, size.height));
    for (int i = 0; i < cycles; ++i) cycle.run();

    std::filesystem::create_directories(folder);
    const auto save = [&](const char* name, const Image& image) {
        write_png(folder + "/" + name, image);
    };
    const float exposure = comparison_exposure(cycle.picture());
    const Image before = tone_mapped(cycle.picture(), exposure);
    save("1_mesh.png", draw_mesh(cycle.id_map()));
    save("2_image.png", before);
    save("3_priorities.png",
         draw_priorities(make_priority_map(cycle.cache(), cycle.id_map(), cycle.scale(),
                                           static_cast<std::uint32_t>(cycle.statistics().cycles))));
    cycle.run();
    save("4_samples.png", draw_samples(before, cycle.last_selection()));
    save("5_new_mesh.png", draw_mesh(cycle.id_map()));
    save("6_new_image.png", tone_mapped(cycle.picture(), exposure));
    return 0;
}

}  // namespace chiaro

int main(int argc, char** argv) {
    return chiaro::run_program(argc, argv, chiaro::run);
}
