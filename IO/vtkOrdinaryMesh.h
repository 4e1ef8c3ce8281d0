// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifndef vtkOrdinaryMesh_h
#define vtkOrdinaryMesh_h

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/Convert.h"

#include <filesystem>

class vtkDataObject;
class vtkPointSet;

namespace smg
{

/** Whether this process is one of several, each of which may have its own pieces. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool hasSeveralProcesses();

/** Whether the mesh is not a piece of a mesh stream: it has no point GlobalIds, or, in a program of
 * one process and not a preview, some that do not number its own points consecutively in the order
 * in which its cells use them first, as those behind a filter that has taken points away
 * (Threshold), joined meshes or given numbers of its own. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isOrdinaryMesh(vtkDataObject& data);

/** Which cells of a mesh count: the solid ones, or without these those of surfaces. */
VTKSTREAMINGMULTIGRIDIO_EXPORT CellChoice countingCells(vtkPointSet& mesh);

/** The mesh that writeOrdinaryMesh() makes, before it is made, as far as the counts of points and
 * cells and the arrays of the points tell; no width and span. */
VTKSTREAMINGMULTIGRIDIO_EXPORT StreamInfo ordinaryMeshInfo(vtkPointSet& mesh);

/** Writes a whole mesh in memory with its arrays, of solids and surfaces the solids: VTK writes it
 * to a file in the scratch folder, and convert() converts that. Throws like convert(), and Error if
 * VTK cannot write the file. */
VTKSTREAMINGMULTIGRIDIO_EXPORT ConversionReport writeOrdinaryMesh(
  vtkPointSet& mesh, const std::filesystem::path& path, const ConversionOptions& options);

} // namespace smg

#endif

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
