#include "import/text_lines.h"

#include "import/fault.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace chiaro {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

bool goes_on(std::string_view line) {
    return line.ends_with('\\') && without_comment(line).size() == line.size();
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return std::nullopt;
    }
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (status == std::errc::result_out_of_range) {
        const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
        return tiny ? 0.0 : double(kInfinity);
    }
    if (status != std::errc()) return std::nullopt;
    return value;
}

std::string_view without_comment(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '#' && (i == 0 || is_blank(text[i - 1]))) return trimmed(text.substr(0, i));
    return text;
}

TextLines::TextLines(std::string_view text, std::string file)
    : rest_(text), file_(std::move(file)) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::string_view TextLines::physical_line() {
    const std::size_t end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    ++lines_taken_;
    if (end == rest_.npos) {
        rest_ = {};
    } else {
        const bool both = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
        rest_.remove_prefix(end + (both ? 2 : 1));
    }
    return line;
}

bool TextLines::next() {
    while (!rest_.empty()) {
        line_ = physical_line();
        number_ = lines_taken_;
        if (goes_on(line_)) {
            joined_.clear();
            for (; goes_on(line_); line_ = rest_.empty() ? "" : physical_line())
                joined_.append(line_.substr(0, line_.size() - 1)) += ' ';
            line_ = joined_.append(line_);
        }
        line_ = trimmed(line_);
        if (!line_.empty() && line_.front() != '#') return true;
    }
    return false;
}

std::string_view TextLines::word() {
    line_ = trimmed(line_);
    if (line_.starts_with('#')) line_ = {};
    std::size_t length = 0;
    while (length < line_.size() && !is_blank(line_[length])) ++length;
    const std::string_view taken = line_.substr(0, length);
    line_.remove_prefix(length);
    return taken;
}

std::string_view TextLines::remainder() {
    const std::string_view all = trimmed(line_);
    line_ = {};
    return all;
}

std::string TextLines::where(std::uint32_t number) const {
    return fmt::format("{}:{}", file_, number);
}

float TextLines::number_word(const char* name) {
    const std::optional<float> value = optional_number(name);
    if (!value) refuse(fmt::format("{} is missing", name));
    return *value;
}

std::optional<float> TextLines::optional_number(const char* name) {
    const std::string_view text = word();
    if (text.empty()) return std::nullopt;
    return to_number(text, name);
}

float TextLines::to_number(std::string_view word, const char* name) const {
    const std::optional<double> value = parse_number(word);
    if (!value) refuse(fmt::format("{}: \"{}\" is not a number", name, printable(word)));
    const auto number = static_cast<float>(*value);
    if (!std::isfinite(number))
        refuse(fmt::format("{}: \"{}\" is not finite", name, printable(word)));
    return number;
}

}  // namespace chiaro
