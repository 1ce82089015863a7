// The free-form statements of OBJ files: from cstype, deg, surf and parm to whole surfaces.
#pragma once

#include "import/text_lines.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace chiaro {

/// A surface of columns x rows bicubic Bezier pieces. Its (3 columns + 1) x (3 rows + 1) control
/// points, u fastest, are corners of ObjGeometry from `first_corner` on.
struct FreeFormSurface {
    std::uint32_t first_corner = 0;
    std::uint32_t columns = 1, rows = 1;
    bool rational = false;
    std::uint32_t line = 0;  // of its `surf`
};

/// Follows free-form statements. What cannot be shown is noted by name in left_out().
class ObjFreeForm {
public:
    explicit ObjFreeForm(TextLines& lines) : lines_(lines) {}

    /// Reads a statement other than `surf` and `end`; false if it is none of free-form geometry.
    bool read(std::string_view key);

    /// `surf`, up to its control points; the reader of corners tells what they were.
    void begin_surface();
    void set_corners(std::size_t first, std::size_t count);
    /// `end`: the surface, unless it is of a kind that is left out, or the end of a curve.
    std::optional<FreeFormSurface> end();
    /// At the end of the file: refuses a surface without `end`.
    void check_ended() const;

    /// What was met and cannot be shown, as "surfaces of cstype bspline", and its first line.
    const std::map<std::string, std::uint32_t>& left_out() const { return left_out_; }

private:
    enum class Body { none, curve, surface };

    void read_kind();
    void read_degrees();
    void read_parameters();
    void leave_out(const std::string& what);
    /// Pieces of a surface along u (0) or v (1).
    std::uint32_t pieces(int direction) const;

    TextLines& lines_;
    std::string kind_;
    bool rational_ = false;
    std::string degrees_;
    Body body_ = Body::none;
    FreeFormSurface surface_;
    std::size_t corner_count_ = 0;
    std::array<std::array<float, 2>, 2> range_ = {};  // of u and of v
    std::array<std::vector<float>, 2> parameters_;
    std::map<std::string, std::uint32_t> left_out_;
};

}  // namespace chiaro
