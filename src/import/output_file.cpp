#include "import/output_file.h"

#include "import/fault.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace chiaro {
namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

// A file beside the one to be replaced, deleted again unless it is renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& target)
        : target_(target), where_(printable(target.string())) {
        path_ = target.string() + ".part-" + std::to_string(::getpid());
        descriptor_ = ::open(path_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw Error(where_, "cannot be written: " + reason(errno));
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
            if (written < 0) throw Error(where_, "cannot be written: " + reason(errno));
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void take_place() {
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) throw Error(where_, "cannot be written: " + reason(errno));
        if (::rename(path_.c_str(), target_.c_str()) != 0)
            throw Error(where_, "cannot be replaced: " + reason(errno));
        path_.clear();
    }

private:
    std::filesystem::path target_;
    std::string where_;
    std::string path_;
    int descriptor_ = -1;
};

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view bytes) {
    check_replaceable(file);
    TemporaryFile temporary(file);
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
    if (std::filesystem::is_directory(file, ignored))
        throw Error(where, "cannot be written: is a folder");
    const bool exists = std::filesystem::exists(file, ignored);
    if (exists && !std::filesystem::is_regular_file(file, ignored))
        throw Error(where, "cannot be written: is not an ordinary file");
    if (exists && ::access(file.c_str(), W_OK) != 0)
        throw Error(where, "cannot be written: " + reason(errno));
    // Only making a file tells whether the folder takes one.
    const TemporaryFile probe(file);
}

}  // namespace chiaro
