/// Errors of VTK's readers and writers as text instead of output on the terminal. For sources that use VTK only.
#pragma once

#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>

#include <new>
#include <string>

#include "meshing/format_error.hpp"

namespace hemoflux::meshing {

/// Keeps the first error of the objects it observes, which VTK would print otherwise.
class VtkListener : public vtkCommand {
  public:
    /// As VTK makes its objects.
    static VtkListener* New() { return new VtkListener; }

    void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
        if (first_.empty()) first_ = said(static_cast<const char*>(data));
    }

    /// The first error, empty if there was none.
    [[nodiscard]] const std::string& first() const { return first_; }

  private:
    /// "ERROR: In file, line n\nvtkClass (0x...): what\n\n" -> "what"
    static std::string said(const std::string& text) {
        const std::size_t colon = text.find("): ");
        const std::size_t begin = colon == std::string::npos ? 0 : colon + 3;
        std::string line = text.substr(begin, text.find('\n', begin) - begin);
        while (!line.empty() && line.back() == '.') line.pop_back();
        return line;
    }

    std::string first_;
};

/// While it lives, VTK prints nothing: some of its objects cannot be listened to.
class VtkSilence {
  public:
    VtkSilence()
        : mode_(vtkOutputWindow::GetInstance()->GetDisplayMode()),
          verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~VtkSilence() {
        vtkOutputWindow::GetInstance()->SetDisplayMode(mode_);
        vtkLogger::SetStderrVerbosity(verbosity_);
    }
    VtkSilence(const VtkSilence&) = delete;
    VtkSilence& operator=(const VtkSilence&) = delete;

  private:
    int mode_;
    vtkLogger::Verbosity verbosity_;
};

/// Lets one of VTK's XML readers read a text. FormatError with the first error it has to tell.
template <class Reader>
void read_xml(Reader& reader, const std::string& text) {
    const VtkSilence silence;
    const vtkNew<VtkListener> listener;
    reader.AddObserver(vtkCommand::ErrorEvent, listener);
    reader.SetParserErrorObserver(listener);
    reader.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
    reader.ReadFromInputStringOn();
    reader.SetInputString(text);
    try {
        reader.Update();
    } catch (const std::bad_alloc&) {
        throw FormatError("it claims more values than memory holds");
    }
    if (!listener->first().empty()) throw FormatError(listener->first());
}

}  // namespace hemoflux::meshing
