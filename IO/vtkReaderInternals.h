// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/UsedFiles.h"
#include "IO/Preview/StreamPreview.h"
#include "IO/vtkFailures.h"
#include "IO/vtkStreamingMeshReader.h"
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
  std::string Name, Scratch;
  std::unique_ptr<smg::OpenedMesh> Mesh;
  std::vector<double> Times; ///< of the time steps; empty: the file has none
  std::int64_t Step = 0;     ///< which is open
  /** Of a file with time steps: the folder of the one that is open, whose name does not change. */
  std::optional<smg::ScratchFolder> OfSteps;
  Stamp Opened; ///< of the opened mesh
  /** Of the last failure to open the mesh: a repeated request neither retries nor reports again. */
  Stamp Failed;
  std::string Reason;    ///< of that failure; empty: none
  vtkTimeStamp Outdated; ///< when a failure was found to be out of date
  /** The columns read with the pieces of the file; none before the first piece. */
  std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> Columns;
  smg::KeptPreview Preview;
  std::string Shown, Outcome; ///< storage of the sentence that is returned

  static Stamp stampOf(vtkStreamingMeshReader& self);

  /** Opens the container unless it is open and up to date, and of one with time steps that of the
   * request: without one, or if it names none, the one that was open. Throws Error if the container
   * is another one than before although nothing has been modified: what was made of it does not go
   * with its pieces. */
  smg::VsmReader& open(vtkStreamingMeshReader& self, vtkInformation* request = nullptr);

  /** Shows why the mesh cannot be opened. */
  void fail(vtkStreamingMeshReader& self, const std::string& reason);
  bool hasFailed(vtkStreamingMeshReader& self) const;
  /** After a failure, looks whether files have changed since. */
  void lookAtFiles(vtkStreamingMeshReader& self);

  void close();

  /** Sets the type of the output according to the cells. */
  static void setOutput(vtkInformation& info, bool isSurface);
  /** Says which time step the output shows. */
  void setTime(vtkPointSet& output, const smg::StreamInfo& info) const;
  /** Reads the real piece with the selected arrays. */
  void readPiece(vtkPointSet& output, int part, int parts, int ghostLevels);
  /** Reads the preview, all of it in the first piece. */
  void readPreview(vtkPointSet& output, int part, const vtkStreamingMeshReader& self,
    const smg::ProgressFunction& progress);

private:
  void requireSameMesh(vtkStreamingMeshReader& self) const;
  std::int64_t stepOf(vtkInformation* request) const;
  void openStep(std::int64_t step, const smg::ProgressFunction& progress);
  void closeMesh();
};
