#include "apps/output/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace hemoflux::output {
namespace {

/// The last line that is not empty.
std::string last_line(const std::string& text) {
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    return last;
}

/// An unnamed file that holds text and stands at its beginning; -1 when there is no room for it.
int file_with(const std::string& text) {
    std::FILE* file = std::tmpfile();
    if (!file) return -1;
    const bool written =
        std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    const int descriptor = written ? ::fcntl(::fileno(file), F_DUPFD_CLOEXEC, 3) : -1;
    std::fclose(file);
    if (descriptor >= 0) ::lseek(descriptor, 0, SEEK_SET);
    return descriptor;
}

}  // namespace

std::string ChildResult::why() const {
    const std::string last = last_line(output);
    const std::string tail = last.empty() ? "" : ": " + last;
    switch (end) {
        case End::exited:
            return fmt::format("it exited with {}{}", code, tail);
        case End::signalled:
            return fmt::format("it was ended by signal {}{}", code, tail);
        case End::timed_out:
            return "it took too long" + tail;
        case End::not_started:
            return "it could not be started";
    }
    return {};
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const auto candidate = std::filesystem::path(folder.empty() ? "." : folder) / name;
        if (::access(candidate.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(candidate))
            return candidate;
    }
    return std::nullopt;
}

ChildResult run_child(const std::vector<std::string>& command, const std::string& input,
                      std::chrono::seconds limit) {
    // everything that allocates is done before fork(): the other threads' locks are frozen in the child
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int in = file_with(input);
    int out[2] = {-1, -1};
    if (in < 0 || ::pipe2(out, O_CLOEXEC) != 0) {
        if (in >= 0) ::close(in);
        return {ChildResult::End::not_started, 0, {}};
    }
    const pid_t child = ::fork();
    if (child == 0) {
        ::setpgid(0, 0);
        ::dup2(in, STDIN_FILENO);
        ::dup2(out[1], STDOUT_FILENO);
        ::dup2(out[1], STDERR_FILENO);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(in);
    ::close(out[1]);
    ChildResult result{ChildResult::End::not_started, 0, {}};
    if (child < 0) {
        ::close(out[0]);
        return result;
    }
    ::setpgid(child, child);
    const auto deadline = std::chrono::steady_clock::now() + limit;
    bool late = false;
    for (;;) {
        using std::chrono::milliseconds;
        const auto left =
            std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) {
            late = true;
            break;
        }
        pollfd descriptor{out[0], POLLIN, 0};
        const int ready = ::poll(&descriptor, 1, static_cast<int>(left.count()));
        if (ready < 0 && errno != EINTR) break;
        if (ready <= 0) continue;
        char buffer[4096];
        const ssize_t n = ::read(out[0], buffer, sizeof buffer);
        if (n <= 0) break;
        result.output.append(buffer, static_cast<std::size_t>(n));
    }
    ::close(out[0]);
    if (late) ::kill(-child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (late) {
        result.end = ChildResult::End::timed_out;
    } else if (WIFSIGNALED(status)) {
        result.end = ChildResult::End::signalled;
        result.code = WTERMSIG(status);
    } else {
        result.code = WEXITSTATUS(status);
        result.end = result.code == 127 ? ChildResult::End::not_started : ChildResult::End::exited;
    }
    return result;
}

}  // namespace hemoflux::output
