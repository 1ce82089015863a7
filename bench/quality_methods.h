// The methods that quality_over_time compares: what each is, and its error over time.
#pragma once

#include "apps/options.h"
#include "base/image.h"
#include "rays/ray_caster.h"
#include "scene/area_lights.h"
#include "scene/edit.h"
#include "shading_cache/mesh_graph.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace chiaro {

/// The true picture, in two independent halves.
struct Reference {
    Image half_1, half_2;
};

/// A scene made ready, as all methods share it, and what that took.
struct Stage {
    struct Loading {
        double embree_seconds = 0, area_lights_seconds = 0;
        std::size_t embree_bytes = 0;
    };

    Scene scene;
    Loading loading;
    RayCaster rays;
    AreaLights area_lights;
    View view;
    int threads;

    Stage(Scene scene, const View& view, int threads);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

/// What there is to compare: a scheme of the cache, or path tracing a pixel.
struct Method {
    const char* option;  // its name on the command line and in names of pictures
    const char* title;   // in the JSON
    bool cached;         // no: path tracing, and the rest means nothing
    RendererName renderer = RendererName::path;
    Scheme scheme = Scheme::best;
    CoarserLevels levels = CoarserLevels::none;
    bool edited = false;  // the cache knows the scene before the edits, which come at 0 s
};

/// The method of that name on the command line. Throws an Error that lists the names.
const Method& method_of(const std::string& option);

/// What the stage's scene was before edits made it what it is.
struct Before {
    Scene scene;
    Camera camera;
    std::vector<Edit> edits;
    double seconds = 10;  // for which the cache has looked at it when they come
};

/// How a method is measured.
struct Measuring {
    Stage& stage;
    const Reference& reference;
    double seconds, path_seconds;  // of the cache, and of path tracing

    /// Pictures are kept in the folder, if one is named, each the first that is measured no earlier
    /// than one of the times [s], ascending.
    std::string picture_folder;
    std::vector<double> picture_times;
    float exposure = 1;              // of all pictures
    const Before* before = nullptr;  // of methods that are `edited`
};

/// Writes `linear` to the folder of pictures as `name`.png.
void keep_picture(const Measuring& measuring, const std::string& name, const Image& linear);

/// Runs the method. `rows` of the result are in order of time, each with the `seconds` after
/// loading, one drawing included, and the picture's `psnr` [dB] and `relmse`; the first is of the
/// first whole picture. `loading` has what the method needs made at load, beside the stage,
/// `first_picture_seconds` where the first cycle's time went, `second_half_seconds` where that of
/// the second half of all went, and `pictures` those that were kept.
nlohmann::ordered_json measure(const Method& method, const Measuring& measuring);

}  // namespace chiaro
