/// Errors as users read them: what is wrong, why it is a problem, what to do. Each kind has its exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace hemoflux {

/// Exit codes of the program.
enum class Exit { done = 0, bad_input = 2, numerical = 3, file = 4, interrupted = 130 };

/// Base of all errors that end a run with a message; what() is "<what>: <why>. <remedy>".
class Error : public std::runtime_error {
  public:
    /// what: the thing that is wrong; remedy: what to do, the beginning of a sentence.
    Error(Exit code, const std::string& what, const std::string& why, const std::string& remedy)
        : std::runtime_error(what + ": " + why + ". " + sentence(remedy) + "."), code_(code) {}
    /// Exit code of the program when this error ends it.
    [[nodiscard]] Exit code() const noexcept { return code_; }

  private:
    /// The remedy begins a sentence of its own.
    static std::string sentence(std::string text) {
        if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
            text[0] = static_cast<char>(text[0] - 'a' + 'A');
        return text;
    }

    Exit code_;
};

/// The user's input cannot be run: wrong key, unit, value or mesh. Raised before the first time step. Exit
/// code 2.
class InputError : public Error {
  public:
    InputError(const std::string& what, const std::string& why, const std::string& remedy)
        : Error(Exit::bad_input, what, why, remedy) {}
};

/// The computation cannot go on: NaN, overstretched spring, lost node. Exit code 3.
class NumericalError : public Error {
  public:
    NumericalError(const std::string& what, const std::string& why, const std::string& remedy)
        : Error(Exit::numerical, what, why, remedy) {}
};

/// A file cannot be read or written. Exit code 4.
class FileError : public Error {
  public:
    FileError(const std::string& what, const std::string& why, const std::string& remedy)
        : Error(Exit::file, what, why, remedy) {}
};

}  // namespace hemoflux
