/// Errors of VTK's readers and writers as text instead of output on the terminal. For sources that use VTK only.
#pragma once

#include <vtkCommand.h>

#include <string>

namespace hemoflux::meshing {

/// Keeps the first error of the objects it observes, which VTK would print otherwise.
class VtkListener : public vtkCommand {
  public:
    static VtkListener* New() { return new VtkListener; }

    void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
        if (first_.empty()) first_ = said(static_cast<const char*>(data));
    }

    /// The first error, empty if there was none.
    [[nodiscard]] const std::string& first() const { return first_; }

  private:
    /// "ERROR: In file, line n\nvtkClass (0x...): what\n\n" -> "what"
    static std::string said(const std::string& text) {
        const std::size_t begin = text.find("): ");
        if (begin == std::string::npos) return text;
        const std::size_t end = text.find('\n', begin);
        return text.substr(begin + 3, end == std::string::npos ? end : end - begin - 3);
    }

    std::string first_;
};

}  // namespace hemoflux::meshing
