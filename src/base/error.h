// The two failures that are not absence (absence is std::optional): what the outside world did
// wrong is an Error, what we did wrong ends the program in check().
#pragma once

#include <stdexcept>
#include <string>

namespace chiaro {

/// A fault of the outside world: a file, an option, a device. Thrown anywhere, caught only in
/// apps/, printed there as the one line `where: what; remedy`.
class Error : public std::runtime_error {
public:
    /// `where`: the file or option, with the place in it ("room.obj:12"); `what`: what is wrong;
    /// `remedy`: what to do about it, may be empty.
    Error(std::string where, std::string what, std::string remedy = {});

    const std::string& where() const { return where_; }
    const std::string& remedy() const { return remedy_; }

private:
    std::string where_;
    std::string remedy_;
};

[[noreturn]] void check_failed(const char* message);

/// States what must hold whatever the input; a breach is our own mistake. On in release builds too.
inline void check(bool holds, const char* message) {
    if (!holds) [[unlikely]]
        check_failed(message);
}

}  // namespace chiaro
