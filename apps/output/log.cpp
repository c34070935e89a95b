#include "apps/output/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

void print(std::FILE* stream, const std::string& text) {
    // a progress line may stand on the terminal; it is drawn again at its next update
    if (::isatty(STDERR_FILENO) && ::isatty(::fileno(stream))) std::fputs("\r\033[K", stderr);
    std::fputs(text.c_str(), stream);
    if (text.empty() || text.back() != '\n') std::fputc('\n', stream);
    std::fflush(stream);
}

}  // namespace

Log::Log(bool quiet) : quiet_(quiet) {}

Log::Log(const std::filesystem::path& file, bool quiet, bool append) : quiet_(quiet) {
    try {
        auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !append);
        file_ = std::make_shared<spdlog::logger>("file", std::move(sink));
    } catch (const spdlog::spdlog_ex& error) {
        throw FileError("cannot write " + file.string(), error.what(), "Check that you may write there");
    }
    file_->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    file_->set_level(spdlog::level::debug);
    file_->flush_on(spdlog::level::debug);
    // a full disk must not end a run for want of a log line; results are checked where they are written
    file_->set_error_handler([](const std::string&) {});
}

void Log::info(const std::string& text) const {
    if (!quiet_) print(stdout, text);
    if (file_) file_->info(text);
}

void Log::warn(const std::string& text) const {
    print(stderr, "warning: " + text);
    if (file_) file_->warn(text);
}

void Log::error(const std::string& text) const {
    print(stderr, "error: " + text);
    if (file_) file_->error(text);
}

void Log::detail(const std::string& text) const {
    if (file_) file_->debug(text);
}

}  // namespace hemoflux::output
