// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/UsedFiles.h"
#include "IO/Preview/StreamPreview.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Solver/Core/Progress.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include "vtkDataArraySelection.h"
#include "vtkNew.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkInformation;
class vtkPointSet;

/** The mesh that a reader has opened, and what it has said of it. */
struct vtkStreamingMeshReader::Internals
{
  /** The state that the output depends on. */
  struct Stamp
  {
    vtkMTimeType Properties = 0;
    smg::InputState File, Container;

    bool areFilesUnchanged() const
    {
      return this->File.isUnchanged() && this->Container.isUnchanged();
    }
  };

  smg::Failures Failures;
  vtkNew<vtkDataArraySelection> PointArrays;
  vtkNew<vtkDataArraySelection> CellArrays;
  std::vector<std::string> OfPoints, OfCells; ///< names of the columns in the lists of arrays
  std::string Name, Scratch;
  std::unique_ptr<smg::OpenedMesh> Mesh;
  std::vector<double> Times; ///< of the time steps; empty: the file has none
  std::int64_t Step = 0;     ///< which is open
  /** What is known of a mesh that is converted when data are requested; none once it is open. */
  std::optional<smg::StreamInfo> Stated;
  /** Of a file that is not a .vsm: of the conversion, whose name does not change. */
  std::optional<smg::ScratchFolder> Folder;
  Stamp Opened; ///< of the opened mesh
  /** Of the last failure to open the mesh: a repeated request neither retries nor reports again. */
  Stamp Failed;
  std::string Reason;    ///< of that failure; empty: none
  vtkTimeStamp Outdated; ///< when what the pipeline was told was found to be out of date
  /** The columns read with the pieces of the file; none before the first piece. */
  std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> Columns;
  smg::KeptPreview Preview;
  std::string Shown, Outcome; ///< storage of the sentence that is returned

  static Stamp stampOf(vtkStreamingMeshReader& self);

  /** The mesh, as far as the pipeline needs it before data are requested. Of a file that takes a
   * conversion it is what the file states; only if that is not valid, it is converted, which says
   * why. Throws Cancelled. */
  const smg::StreamInfo& look(vtkStreamingMeshReader& self);

  /** Opens the container unless it is open and up to date, and of one with time steps that of the
   * request: without one, or if it names none, the one that was open. Throws Error if the container
   * is another one than before although nothing has been modified: what was made of it does not go
   * with its pieces. */
  smg::VsmReader& open(vtkStreamingMeshReader& self, vtkInformation* request = nullptr);

  /** Opens a mesh of which look() has told only what the file states, and tells all of it. Shows
   * why that is not possible. Throws Cancelled. */
  void openStated(vtkStreamingMeshReader& self, vtkInformation& output);

  /** Tells the pipeline what is known of the mesh. */
  void tell(vtkStreamingMeshReader& self, vtkInformation& output);

  /** Shows why the mesh cannot be opened. */
  void fail(vtkStreamingMeshReader& self, const std::string& reason);
  bool hasFailed(vtkStreamingMeshReader& self) const;
  /** After a failure, looks whether files have changed since. */
  void lookAtFiles(vtkStreamingMeshReader& self);

  void close();

  /** Sets the type of the output according to the cells. */
  static void setOutput(vtkInformation& info, bool isSurface);
  /** Throws Error unless the mesh is of the type of the output. */
  void requireType(vtkPointSet& output, const smg::StreamInfo& info) const;
  /** Says which time step the output shows. */
  void setTime(vtkPointSet& output) const;
  /** Reads the real piece with the selected arrays. */
  void readPiece(vtkPointSet& output, int part, int parts, int ghostLevels);
  /** Reads the preview, all of it in the first piece. */
  void readPreview(vtkPointSet& output, int part, const vtkStreamingMeshReader& self,
    const smg::ProgressFunction& progress);

private:
  bool state(vtkStreamingMeshReader& self);
  void requireSameMesh(vtkStreamingMeshReader& self) const;
  std::int64_t stepOf(vtkInformation* request) const;
  bool isOpen(vtkStreamingMeshReader& self) const;
  void takeName(vtkStreamingMeshReader& self);
  std::filesystem::path file();
  void openStep(std::int64_t step, const smg::ProgressFunction& progress);
  void closeMesh();
};
