// chiaro diff: how far one picture is from another.

#include "apps/commands.h"
#include "base/image_difference.h"
#include "import/image_file.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace chiaro {

int diff_command(const Options& options) {
    const Image a = read_image(options.picture_a);
    const ImageDifference d = difference(a, read_image(options.picture_b));
    nlohmann::ordered_json j;
    // JSON has no infinity: equal pictures have a PSNR of null.
    j["psnr"] = std::isfinite(d.psnr) ? nlohmann::ordered_json(d.psnr) : nlohmann::ordered_json();
    j["relmse"] = d.relmse;
    j["rmse"] = d.rmse;
    j["k"] = d.k;
    std::printf("%s\n", j.dump().c_str());
    return 0;
}

}  // namespace chiaro
