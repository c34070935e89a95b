#include "apps/output/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

FileError cannot_write(const std::filesystem::path& path, int error) {
    return {"cannot write " + path.string(), std::strerror(error),
            error == ENOSPC || error == EDQUOT || error == EFBIG
                ? "Free some space or choose another folder with --output"
                : "Check that the folder exists and that you may write there"};
}

/// An open descriptor of the temporary file, which is removed unless it was renamed.
class Temporary {
  public:
    explicit Temporary(const std::filesystem::path& target)
        : path_(target.parent_path() / fmt::format(".{}.tmp", target.filename().string())),
          descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
        if (descriptor_ < 0) throw cannot_write(target, errno);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(path_.c_str());
    }

    /// Returns 0 or the errno of the step that failed.
    int write_and_rename(std::string_view content, const std::filesystem::path& target) {
        while (!content.empty()) {
            const ssize_t n = ::write(descriptor_, content.data(), content.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) return errno;
            content.remove_prefix(static_cast<std::size_t>(n));
        }
        if (::fsync(descriptor_) != 0) return errno;
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) return errno;
        if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
        renamed_ = true;
        return 0;
    }

  private:
    std::filesystem::path path_;
    int descriptor_;
    bool renamed_ = false;
};

/// Makes the renaming itself last through a power cut; some file systems cannot do this and it is then left.
void sync_folder(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view content) {
    Temporary temporary(path);
    if (const int error = temporary.write_and_rename(content, path)) throw cannot_write(path, error);
    sync_folder(path.parent_path());
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    if (!file || std::filesystem::is_directory(path) || !(content << file.rdbuf()).good()) {
        // an empty file sets failbit on the output stream without being an error
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored) && file.is_open() &&
            std::filesystem::file_size(path, ignored) == 0)
            return {};
        throw FileError("cannot read " + path.string(),
                        std::filesystem::is_directory(path, ignored) ? "it is a folder"
                                                                     : std::strerror(errno ? errno : EIO),
                        "Check the name and that you may read it");
    }
    return std::move(content).str();
}

}  // namespace hemoflux::output
