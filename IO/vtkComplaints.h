// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkComplaints_h
#define vtkComplaints_h

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <string>

namespace smg
{

/**
 * Collects the error messages of VTK during its lifetime instead of printing them. Some are sent as
 * events, others only as text to VTK's output window, which is replaced for this time.
 */
class vtkComplaints
{
public:
  vtkComplaints()
    : Before(vtkOutputWindow::GetInstance())
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<vtkComplaints*>(self)->note(static_cast<const char*>(text)); });
    vtkNew<Window> window;
    window->Complaints = this;
    vtkOutputWindow::SetInstance(window);
  }
  ~vtkComplaints() { vtkOutputWindow::SetInstance(this->Before); }
  vtkComplaints(const vtkComplaints&) = delete;
  vtkComplaints& operator=(const vtkComplaints&) = delete;

  /** An observer for ErrorEvent. */
  vtkCommand* command() { return this->Command; }
  /** The first message, in one line; empty if there is none. */
  const std::string& text() const { return this->Text; }

private:
  class Window : public vtkOutputWindow
  {
  public:
    static Window* New() { VTK_STANDARD_NEW_BODY(Window); }
    vtkTypeMacro(Window, vtkOutputWindow);
    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override { this->Complaints->note(text); }
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}

    vtkComplaints* Complaints = nullptr;
  };

  /** VTK's text is "ERROR: In FILE, line N\nCLASS (ADDRESS): SENTENCE\n ...". */
  void note(const char* text)
  {
    if (!text || !this->Text.empty())
    {
      return;
    }
    this->Text = text;
    const std::size_t colon = this->Text.find("): ");
    const std::size_t line = this->Text.find('\n');
    this->Text.erase(0, colon != std::string::npos  ? colon + 3
                        : line != std::string::npos ? line + 1
                                                    : 0);
    this->Text.erase(std::min(this->Text.find('\n'), this->Text.size()));
    this->Text.erase(this->Text.find_last_not_of(" .:!") + 1);
    this->Text = this->Text.empty() ? "unknown error" : this->Text;
  }

  vtkSmartPointer<vtkOutputWindow> Before;
  vtkNew<vtkCallbackCommand> Command;
  std::string Text;
};

} // namespace smg

#endif
