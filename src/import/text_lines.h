// The lines and words of OBJ and MTL files, and the numbers in them.
#pragma once

#include "base/error.h"
#include "base/vec.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace chiaro {

/// Steps through the lines of a text. A line that ends in a backslash goes on in the next; a line
/// ends in LF, CR LF or CR; empty lines and lines of comment are skipped, and so is a byte order
/// mark. A comment ends with its line, whatever that ends in.
class TextLines {
public:
    /// `text` must outlive this; `file` is how messages name it.
    TextLines(std::string_view text, std::string file);

    /// Moves to the next line; false at the end.
    bool next();
    /// The next word of the line; empty at its end or where a comment begins.
    std::string_view word();
    /// What is left of the line, without the white space round it; a comment is part of it (names
    /// may have a # in them: see without_comment).
    std::string_view remainder();

    /// Number of the line (the first of those that a backslash joins), from 1.
    std::uint32_t number() const { return number_; }
    /// "file:number", for messages.
    std::string where() const { return where(number_); }
    std::string where(std::uint32_t number) const;
    [[noreturn]] void refuse(const std::string& what) const { throw Error(where(), what); }

    /// The next word as a number. Throws an Error at the line if there is none (`name` says what is
    /// missing), or it is malformed or not finite.
    float number_word(const char* name);
    /// The same, if the line has another word.
    std::optional<float> optional_number(const char* name);
    /// The same, of a word that has been taken already.
    float to_number(std::string_view word, const char* name) const;

private:
    std::string_view physical_line();

    std::string_view rest_;
    std::string_view line_;
    std::string joined_;
    std::string file_;
    std::uint32_t number_ = 0;
    std::uint32_t lines_taken_ = 0;
};

/// `word` as a number, whatever the locale; a + may come before it. Empty if it is malformed, and
/// infinite if it is too large.
std::optional<double> parse_number(std::string_view word);

/// What of `text` comes before a # that begins a word; all if none does.
std::string_view without_comment(std::string_view text);

}  // namespace chiaro
