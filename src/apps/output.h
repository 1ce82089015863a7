// Pictures, figures and progress out.
#pragma once

#include "apps/options.h"
#include "base/image.h"
#include "update/update_cycle.h"

#include <chrono>
#include <vector>

namespace chiaro {

/// Throws the Error that writing the options' outputs would end in, before any work is done.
void check_outputs(const Options& options);

/// Writes a linear picture: .exr as it is, .png through the tone map at the options' exposure.
void save_picture(const std::string& file, const Options& options, const Image& picture);

/// What was reached when a picture of a replay was taken.
struct FrameFigures {
    double time = 0;     // that was asked for [s]
    double seconds = 0;  // of wall time after loading
    std::size_t points_shaded = 0;
    std::size_t stale = 0;  // estimates from before edits
    std::size_t bytes = 0;  // UpdateCycle::bytes()
};

/// The figures of a run as `--stats` writes them.
struct RunFigures {
    double seconds = 0;  // of wall time after loading
    double first_picture_seconds = 0;
    std::vector<FrameFigures> frames;
};
std::string statistics_json(const UpdateCycle& cycle, const RunFigures& figures);

/// A line `chiaro: what` or `chiaro: warning: what` on standard error, whatever is in it.
void complain(const std::string& what);
void warn(const std::string& what);

/// A line on a terminal that shows how far the work is; silent where standard error is none.
class ProgressBar {
public:
    ProgressBar();
    /// `part` in [0, 1]. Redraws at most ten times a second.
    void show(double part, const std::string& note);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

private:
    bool terminal_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point last_;
};

}  // namespace chiaro
