#include "import/output_file.h"

#include "import/fault.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace chiaro {
namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

// A file beside `target` that is to replace it, deleted again unless it does. `target` has no links
// in it.
class TemporaryFile {
public:
    TemporaryFile(std::filesystem::path target, std::string where)
        : target_(std::move(target)), where_(std::move(where)) {
        // A name of its own, so that it is never longer than the target's may be. What a killed
        // process of the same number left is passed over.
        for (int n = 0; descriptor_ < 0; ++n) {
            path_ = target_.parent_path() / fmt::format(".chiaro-{}-{}", ::getpid(), n);
            descriptor_ = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
            if (descriptor_ < 0 && (errno != EEXIST || n == 99)) refuse("written");
        }
        struct stat replaced;
        if (::stat(target_.c_str(), &replaced) == 0) ::fchmod(descriptor_, replaced.st_mode & 0777);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!path_.empty()) ::unlink(path_.c_str());
    }

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) refuse("written");
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void take_place() {
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) refuse("written");
        if (::rename(path_.c_str(), target_.c_str()) != 0) refuse("replaced");
        path_.clear();
    }

private:
    [[noreturn]] void refuse(const char* done) const {
        throw Error(where_, fmt::format("cannot be {}: {}", done, reason(errno)));
    }

    std::filesystem::path target_;
    std::string where_;
    std::filesystem::path path_;
    int descriptor_ = -1;
};

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view bytes) {
    check_replaceable(file);
    TemporaryFile temporary(real_path(file), printable(file.string()));
    temporary.write(bytes);
    temporary.take_place();
}

void check_replaceable(const std::filesystem::path& file) {
    const std::string where = printable(file.string());
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code ignored;
    if (!std::filesystem::exists(folder, ignored))
        throw Error(where, "cannot be written: there is no folder " + printable(folder.string()),
                    "make the folder first");
    if (!std::filesystem::is_directory(folder, ignored))
        throw Error(where, "cannot be written: " + printable(folder.string()) + " is no folder");
    struct stat status;
    const bool exists = ::stat(file.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) throw Error(where, "cannot be written: " + reason(errno));
    if (exists && S_ISDIR(status.st_mode)) throw Error(where, "cannot be written: is a folder");
    if (exists && !S_ISREG(status.st_mode))
        throw Error(where, "cannot be written: is not an ordinary file");
    if (exists && ::access(file.c_str(), W_OK) != 0)
        throw Error(where, "cannot be written: " + reason(errno));
    // Only making a file tells whether the folder takes one.
    const TemporaryFile probe(real_path(file), where);
}

}  // namespace chiaro
