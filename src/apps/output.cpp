#include "apps/output.h"

#include "base/error.h"
#include "base/tone_map.h"
#include "import/fault.h"
#include "import/image_file.h"
#include "import/output_file.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace chiaro {

void check_outputs(const Options& options) {
    if (options.output.empty()) throw Error("-o", "no file is named", "give a .png or .exr file");
    if (options.exposure && !std::isfinite(*options.exposure))
        throw Error("--exposure", "it must be a finite number of stops");
    check_writable(options.output);
    if (options.statistics.empty()) return;
    check_replaceable(options.statistics);
    if (real_path(options.statistics) == real_path(options.output))
        throw Error("--stats", "'" + options.statistics + "' is the picture too",
                    "name another file");
}

void save_picture(const std::string& file, const Options& options, const Image& picture) {
    if (lower_extension(file) == ".exr") {
        write_exr(file, picture);
        return;
    }
    const float exposure =
        options.exposure ? std::exp2(*options.exposure) : automatic_exposure(picture);
    write_png(file, tone_mapped(picture, exposure));
}

std::string statistics_json(const UpdateCycle& cycle, const RunFigures& figures) {
    const Statistics& s = cycle.statistics();
    const double patches =
        static_cast<double>(std::max<std::size_t>(cycle.cache().patches().size(), 1));
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);

    nlohmann::ordered_json j;
    j["cycles"] = s.cycles;
    j["points_shaded"] = s.points_shaded;
    j["points_per_second"] =
        figures.seconds > 0 ? static_cast<double>(s.points_shaded) / figures.seconds : 0;
    j["patches"] = cycle.cache().patches().size();
    j["vertices"] = cycle.cache().vertices().size();
    j["bytes_per_patch"] = static_cast<double>(cycle.bytes()) / patches;
    j["peak_rss_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    j["first_picture_seconds"] = figures.first_picture_seconds;
    const double cycles = static_cast<double>(std::max<std::size_t>(s.cycles, 1));
    for (std::size_t i = 0; i < kSteps; ++i)
        j["cycle_ms"][kStepNames[i]] = 1e3 * s.timings.seconds[i] / cycles;
    j["cycle_ms"]["total"] = 1e3 * s.seconds / cycles;
    for (const FrameFigures& frame : figures.frames)
        j["frames"].push_back({{"t", frame.time},
                               {"seconds", frame.seconds},
                               {"points_shaded", frame.points_shaded},
                               {"stale", frame.stale},
                               {"bytes", frame.bytes}});
    return j.dump(2) + "\n";
}

void complain(const std::string& what) {
    std::fprintf(stderr, "chiaro: %s\n", printable(what, what.max_size()).c_str());
}

void warn(const std::string& what) {
    complain("warning: " + what);
}

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(double part, const std::string& note) {
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || (drawn_ && now - last_ < std::chrono::milliseconds(100))) return;
    constexpr int kWidth = 30;
    const int full = static_cast<int>(std::clamp(part, 0.0, 1.0) * kWidth);
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    std::fprintf(stderr, "\r[%s] %3.0f%%  %s\033[K", bar.c_str(), 100 * std::clamp(part, 0.0, 1.0),
                 note.c_str());
    std::fflush(stderr);
    last_ = now;
    drawn_ = true;
}

ProgressBar::~ProgressBar() {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace chiaro
