// Runs the built `chiaro` as users do.
#pragma once

#include "import/import_testing.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

namespace chiaro {

struct Outcome {
    int status = -1;  // exit status; 1000 + signal where one ended the program
    std::string out, err;
    double seconds = 0;
};

using Arguments = std::vector<std::string>;

/// A `chiaro` that runs, with its three streams in files. Ended when the object goes.
class Command {
public:
    explicit Command(const Arguments& arguments, const std::string& input = "") {
        const auto in = folder_.write("in", input);
        const std::string out = file("out"), err = file("err");
        std::vector<char*> argv = {const_cast<char*>(CHIARO_BINARY)};
        for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
        argv.push_back(nullptr);
        pid_ = ::fork();
        if (pid_ != 0) return;
        const int flags = O_CREAT | O_WRONLY;
        ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO);
        ::dup2(::open(out.c_str(), flags, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), flags, 0600), STDERR_FILENO);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;
    ~Command() {
        if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
    }

    void send(int signal) const { ::kill(pid_, signal); }

    /// Waits for its end, for at most `seconds`; fails the test if it does not come.
    Outcome finish(double seconds = 120) {
        Outcome outcome;
        int status = 0;
        while (::waitpid(pid_, &status, WNOHANG) == 0) {
            outcome.seconds = elapsed();
            if (outcome.seconds > seconds) {
                ADD_FAILURE() << "still running after " << seconds << " s";
                ::kill(pid_, SIGKILL);
                ::waitpid(pid_, &status, 0);
                break;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        pid_ = -1;
        outcome.seconds = elapsed();
        outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
        outcome.out = read_text(file("out"));
        outcome.err = read_text(file("err"));
        return outcome;
    }

private:
    std::string file(const char* name) const { return (folder_.path() / name).string(); }
    double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    TempFolder folder_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    pid_t pid_ = -1;
};

inline Outcome chiaro_with(const Arguments& arguments, const std::string& input = "") {
    return Command(arguments, input).finish();
}

inline std::string words(const Arguments& arguments) {
    std::string line = "chiaro";
    for (const std::string& a : arguments) line += " " + a;
    return line;
}

/// The lines of standard error that are no warnings.
inline std::vector<std::string> complaints(const Outcome& outcome) {
    std::vector<std::string> lines;
    std::istringstream text(outcome.err);
    for (std::string line; std::getline(text, line);)
        if (!line.starts_with("chiaro: warning: ")) lines.push_back(line);
    return lines;
}

/// The program did its work: status 0 and not a word beside warnings.
inline Outcome expect_done(const Arguments& arguments, const std::string& input = "") {
    const Outcome outcome = chiaro_with(arguments, input);
    EXPECT_EQ(outcome.status, 0) << words(arguments) << "\n" << outcome.err;
    EXPECT_TRUE(complaints(outcome).empty()) << words(arguments) << "\n" << outcome.err;
    return outcome;
}

/// The program refused, as it should: one line, `chiaro: ...`, that holds `said`; nothing on
/// standard output; and at once.
inline void expect_refused(const Arguments& arguments, const std::string& said, int status = 2) {
    const Outcome outcome = chiaro_with(arguments);
    const auto lines = complaints(outcome);
    EXPECT_EQ(outcome.status, status) << words(arguments) << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << words(arguments);
    ASSERT_EQ(lines.size(), 1u) << words(arguments) << "\n" << outcome.err;
    EXPECT_TRUE(lines[0].starts_with("chiaro: ")) << outcome.err;
    EXPECT_NE(lines[0].find(said), std::string::npos) << lines[0] << " lacks " << said;
    EXPECT_LT(outcome.seconds, 5) << words(arguments);
}

}  // namespace chiaro
