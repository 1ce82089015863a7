// Radiance pictures (Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's File Formats).

#include "import/fault.h"
#include "import/image_codecs.h"
#include "import/text_lines.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

namespace chiaro {
namespace {

using Quad = std::array<std::uint8_t, 4>;  // three mantissas and the exponent that they share

// Scanlines of other lengths are never in the newer run-length coding.
constexpr std::size_t kLeastNewLength = 8;
constexpr std::size_t kMostNewLength = 0x7fff;

// From CIE XYZ to Rec. 709 (IEC 61966-2-1).
constexpr Mat3 kFromXyz = {
    {3.2406f, -0.9689f, 0.0557f}, {-1.5372f, 1.8758f, -0.2040f}, {-0.4986f, 0.0415f, 1.0570f}};

// How rows and columns of the picture come in the file: scanlines along one axis, one after the
// other along the other.
struct Order {
    std::size_t width = 0, height = 0;
    bool columns = false;      // a scanline is a column
    bool from_right = false;   // x runs to the left
    bool from_bottom = false;  // y runs up

    std::size_t scanlines() const { return columns ? width : height; }
    std::size_t length() const { return columns ? height : width; }
};

struct Header {
    bool xyz = false;
    Vec3 scale = Vec3(1);  // by which values are to be multiplied
    Order order;
};

// The bytes from the first to the last, and where in them reading has come to.
class HdrReader {
public:
    HdrReader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

    Header read_header();
    std::vector<Quad> read_quads(const Order& order);

private:
    [[noreturn]] void refuse_line(const std::string& what) const {
        throw Error(fmt::format("{}:{}", where_, line_number_), "Radiance: " + what);
    }
    [[noreturn]] void refuse_scanline(const std::string& what) const {
        throw Error(where_, fmt::format("Radiance: scanline {}: {}", scanline_, what));
    }

    std::string_view next_line();
    void read_variable(std::string_view line, Header& header) const;
    float positive_number(std::string_view& text) const;
    Order parse_resolution(std::string_view line) const;

    std::uint8_t next_byte() {
        if (at_ == bytes_.size()) refuse_scanline("the file ends too early");
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }
    Quad next_quad() { return {next_byte(), next_byte(), next_byte(), next_byte()}; }
    void read_scanline(std::span<Quad> line);
    void read_new_scanline(std::span<Quad> line);
    void read_old_scanline(Quad first, std::span<Quad> line);

    std::string_view bytes_;
    const std::string& where_;
    std::size_t at_ = 0;
    std::size_t line_number_ = 0;
    std::size_t scanline_ = 0;
};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Cuts the next word off `text`; empty at its end.
std::string_view take_word(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    return word;
}

std::string_view HdrReader::next_line() {
    ++line_number_;
    const auto end = bytes_.find('\n', at_);
    if (end == bytes_.npos) refuse_line("the header does not end");
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

float HdrReader::positive_number(std::string_view& text) const {
    const std::string_view word = take_word(text);
    const std::optional<double> value = parse_number(word);
    const auto number = static_cast<float>(value.value_or(0));
    if (!(number > 0 && number < kInfinity))
        refuse_line(fmt::format("'{}' is no number above 0", printable(word)));
    return number;
}

// Exposures and colour corrections tell what the values were multiplied by, each further one in
// addition to those before. Of other variables none changes what a value means.
void HdrReader::read_variable(std::string_view line, Header& header) const {
    const auto equals = line.find('=');
    if (equals == line.npos) return;
    const std::string_view name = line.substr(0, equals);  // indented: of another picture
    std::string_view value = trimmed(line.substr(equals + 1));
    if (name == "FORMAT") {
        header.xyz = value == "32-bit_rle_xyze";
        if (!header.xyz && value != "32-bit_rle_rgbe")
            refuse_line(fmt::format("there is no format '{}'", printable(value)));
    } else if (name == "EXPOSURE") {
        header.scale /= positive_number(value);
    } else if (name == "COLORCORR") {
        for (int i = 0; i < 3; ++i) header.scale[i] /= positive_number(value);
    }
}

// As `-Y 512 +X 1024`: scanlines run along the second axis, the sign tells which way; y counts
// upward.
Order HdrReader::parse_resolution(std::string_view line) const {
    const auto refuse = [&] {
        refuse_line(fmt::format("'{}' is no resolution, as -Y 512 +X 1024 is", printable(line)));
    };
    Order order;
    std::string_view rest = line;
    std::string seen;
    for (int i = 0; i < 2; ++i) {
        const std::string_view axis = take_word(rest);
        const std::string_view digits = take_word(rest);
        const std::optional<double> size = parse_number(digits);
        const bool whole = !digits.empty() && digits.find_first_not_of("0123456789") == digits.npos;
        if (axis.size() != 2 || !size || !whole || *size > 0xffff'ffff) refuse();
        if ((axis[0] != '+' && axis[0] != '-') || (axis[1] != 'X' && axis[1] != 'Y')) refuse();
        seen += axis[1];
        const bool reversed = axis == "-X" || axis == "+Y";
        (axis[1] == 'X' ? order.from_right : order.from_bottom) = reversed;
        (axis[1] == 'X' ? order.width : order.height) = static_cast<std::size_t>(*size);
    }
    if (seen != "XY" && seen != "YX") refuse();
    if (!trimmed(rest).empty()) refuse();
    order.columns = seen == "XY";
    return order;
}

Header HdrReader::read_header() {
    Header header;
    next_line();  // the signature
    for (std::string_view line = next_line(); !line.empty(); line = next_line())
        read_variable(line, header);
    for (int i = 0; i < 3; ++i)
        if (!(header.scale[i] > 0 && header.scale[i] < kInfinity))
            refuse_line("the exposures together are beyond what numbers can be");
    header.order = parse_resolution(next_line());
    return header;
}

// Each channel by itself, in runs of one byte and in stretches of different ones.
void HdrReader::read_new_scanline(std::span<Quad> line) {
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t x = 0; x < line.size();) {
            const std::size_t code = next_byte();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128 : code;
            if (count == 0 || count > line.size() - x) refuse_scanline("a run of a wrong length");
            std::uint8_t value = run ? next_byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i) {
                if (!run) value = next_byte();
                line[x++][channel] = value;
            }
        }
}

// Pixel by pixel; (1, 1, 1, n) repeats the one before, several of them as the digits of a number.
void HdrReader::read_old_scanline(Quad first, std::span<Quad> line) {
    int shift = 0;
    for (std::size_t x = 0; x < line.size();) {
        const Quad quad = x == 0 ? first : next_quad();
        if (quad[0] != 1 || quad[1] != 1 || quad[2] != 1) {
            line[x++] = quad;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 32 ? std::size_t{quad[3]} << shift : line.size();
        if (x == 0 || count > line.size() - x) refuse_scanline("a run of a wrong length");
        for (std::size_t i = 0; i < count; ++i, ++x) line[x] = line[x - 1];
        shift += 8;
    }
}

void HdrReader::read_scanline(std::span<Quad> line) {
    const Quad first = next_quad();
    const bool fits = line.size() >= kLeastNewLength && line.size() <= kMostNewLength;
    if (!fits || first[0] != 2 || first[1] != 2 || first[2] >= 128) {
        read_old_scanline(first, line);
        return;
    }
    if ((std::size_t{first[2]} << 8 | first[3]) != line.size())
        refuse_scanline("it is not as long as the picture is wide");
    read_new_scanline(line);
}

// Memory is taken as scanlines are found, so that a short file takes little, whatever it says.
std::vector<Quad> HdrReader::read_quads(const Order& order) {
    std::vector<Quad> quads;
    for (scanline_ = 0; scanline_ < order.scanlines(); ++scanline_) {
        quads.resize(quads.size() + order.length());
        read_scanline(std::span(quads).last(order.length()));
    }
    return quads;
}

// As most programs do. Radiance adds half a step, with which 1 would not be 1.
Rgb decode(Quad quad, const Header& header) {
    if (quad[3] == 0) return Rgb(0);
    const float unit = std::ldexp(1.0f, int{quad[3]} - 128 - 8);
    const Rgb value = header.scale * (unit * Rgb(quad[0], quad[1], quad[2]));
    return header.xyz ? kFromXyz * value : value;
}

}  // namespace

bool is_hdr(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

Image decode_hdr(std::string_view bytes, const std::string& where) {
    HdrReader reader(bytes, where);
    const Header header = reader.read_header();
    const Order& order = header.order;
    check_image_size(order.width, order.height, kMaxPicturePixels, where);
    const std::vector<Quad> quads = reader.read_quads(order);

    Image image(static_cast<int>(order.width), static_cast<int>(order.height));
    for (std::size_t i = 0; i < quads.size(); ++i) {
        auto x = static_cast<int>(order.columns ? i / order.length() : i % order.length());
        auto y = static_cast<int>(order.columns ? i % order.length() : i / order.length());
        if (order.from_right) x = image.width - 1 - x;
        if (order.from_bottom) y = image.height - 1 - y;
        const Rgb value = decode(quads[i], header);
        if (!glm::all(glm::lessThan(glm::abs(value), Rgb(kInfinity))))
            throw Error(where, fmt::format("Radiance: pixel ({}, {}) is too bright", x, y));
        // Colours that Rec. 709 cannot show lose what is negative of them.
        image.at(x, y) = glm::max(value, Rgb(0));
    }
    return image;
}

}  // namespace chiaro
