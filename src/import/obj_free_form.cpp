#include "import/obj_free_form.h"

#include "import/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

namespace chiaro {

bool ObjFreeForm::read(std::string_view key) {
    static const std::set<std::string_view> kCurves = {"curv", "curv2"};
    static const std::set<std::string_view> kIgnored = {"bmat", "step"};
    static const std::set<std::string_view> kTrims = {"trim", "hole"};
    static const std::set<std::string_view> kOther = {"vp",  "scrv", "sp",  "con",
                                                      "bzp", "bsp",  "cdc", "cdp"};
    if (key == "cstype") {
        read_kind();
    } else if (key == "deg") {
        read_degrees();
    } else if (key == "parm") {
        if (body_ == Body::surface) read_parameters();
    } else if (kCurves.contains(key)) {
        leave_out(fmt::format("curves ({})", key));
        body_ = Body::curve;
    } else if (kTrims.contains(key)) {
        leave_out(fmt::format("trims of surfaces ({})", key));
    } else if (kOther.contains(key)) {
        leave_out(fmt::format("statements \"{}\"", key));
    } else if (!kIgnored.contains(key)) {
        return false;
    }
    return true;
}

void ObjFreeForm::read_kind() {
    std::string_view word = lines_.word();
    rational_ = word == "rat";
    if (rational_) word = lines_.word();
    if (word.empty()) lines_.refuse("cstype names no type");
    kind_ = word;
}

void ObjFreeForm::read_degrees() {
    const std::string_view u = lines_.word(), v = lines_.word();
    degrees_ = std::string(u) + " " + std::string(v);
}

void ObjFreeForm::leave_out(const std::string& what) {
    constexpr std::size_t kMostKinds = 8;
    if (left_out_.size() < kMostKinds) left_out_.try_emplace(what, lines_.number());
}

void ObjFreeForm::begin_surface() {
    check_ended();
    body_ = Body::surface;
    surface_ = {.rational = rational_, .line = lines_.number()};
    for (auto& parameters : parameters_) parameters.clear();
    constexpr const char* kNames[2][2] = {{"u0", "u1"}, {"v0", "v1"}};
    for (int direction = 0; direction < 2; ++direction)
        for (int end = 0; end < 2; ++end)
            range_[direction][end] = lines_.number_word(kNames[direction][end]);
}

void ObjFreeForm::set_corners(std::size_t first, std::size_t count) {
    surface_.first_corner = static_cast<std::uint32_t>(first);
    corner_count_ = count;
}

void ObjFreeForm::read_parameters() {
    const std::string_view name = lines_.word();
    if (name != "u" && name != "v")
        lines_.refuse(fmt::format("parm: \"{}\" is neither u nor v", printable(name)));
    std::vector<float>& parameters = parameters_[name == "u" ? 0 : 1];
    parameters.clear();
    while (const std::optional<float> value = lines_.optional_number("parm"))
        parameters.push_back(*value);
    if (parameters.size() < 2) lines_.refuse("parm: there are fewer than 2 values");
}

std::uint32_t ObjFreeForm::pieces(int direction) const {
    const std::vector<float>& parameters = parameters_[direction];
    if (parameters.empty()) return 1;
    // Those of other types are knots, which may repeat.
    if (std::ranges::adjacent_find(parameters, std::greater_equal{}) != parameters.end())
        lines_.refuse(fmt::format("parm: the values of the surface of line {} do not increase",
                                  surface_.line));
    const std::array<float, 2> whole = {parameters.front(), parameters.back()};
    if (range_[direction] != whole)
        lines_.refuse(fmt::format(
            "the surface of line {} is cut off: its {} runs from {} to {}, parm from {} to {}",
            surface_.line, direction == 0 ? "u" : "v", range_[direction][0], range_[direction][1],
            whole[0], whole[1]));
    return static_cast<std::uint32_t>(parameters.size() - 1);
}

std::optional<FreeFormSurface> ObjFreeForm::end() {
    const Body ended = std::exchange(body_, Body::none);
    if (ended != Body::surface) return std::nullopt;
    if (kind_ != "bezier") {
        leave_out(kind_.empty() ? "surfaces without a cstype"
                                : "surfaces of cstype " + printable(kind_));
        return std::nullopt;
    }
    if (degrees_ != "3 3") {
        leave_out("surfaces of degrees other than 3 3 (deg)");
        return std::nullopt;
    }
    surface_.columns = pieces(0);
    surface_.rows = pieces(1);
    const std::size_t expected =
        (std::size_t{3} * surface_.columns + 1) * (std::size_t{3} * surface_.rows + 1);
    if (corner_count_ != expected)
        lines_.refuse(
            fmt::format("the surface of line {} has {} control points, not the {} of "
                        "{} x {} bicubic pieces",
                        surface_.line, corner_count_, expected, surface_.columns, surface_.rows));
    return surface_;
}

void ObjFreeForm::check_ended() const {
    if (body_ == Body::surface)
        throw Error(lines_.where(surface_.line), "the surface has no \"end\"");
}

}  // namespace chiaro
