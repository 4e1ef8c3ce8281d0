// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/UsedFiles.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

class MeshJob;

/** The file of the result of a computation: the mesh with it, in the order of the file that the
 * mesh was made of wherever the format can have it. */
class SMG_EXPORT ResultFile
{
public:
  /** The files, how the result is written, and what it has. */
  struct Options
  {
    /** The file of the mesh; empty: it was made of arrays. */
    std::filesystem::path in;
    std::filesystem::path out, scratch = {};
    /** Whether points of the mesh were merged, so that the order of its points is not known. */
    bool welds = false;
    /** The columns of the result, for an error, for example "a solution"; empty if the result is
     * the mesh with other positions. */
    std::string columns = {};
    /** The names of these columns, of the vertices, if the mesh has them. */
    std::vector<std::string> changed = {};
    int threads = 0;   ///< that write; 0: one per core
    bool text = false; ///< see WriteMeshOptions
    /** Whether the mesh with the result has columns or cells that are not in its file, so that this
     * cannot be written again with other positions. */
    bool adds = false;
    /** Adds columns to vertices of no cell; see WriteMeshOptions. */
    CompleteIsolated isolated = {};
    /** Changes them as they are written to a .vsm file; see WriteMeshOptions::changeIsolated. */
    CompleteIsolated merged = {};
    /** The state of `in` before it was read; none: now, before it is read. */
    std::optional<InputState> state = {};
  };

  /** Throws Error if the name of the result is invalid. */
  explicit ResultFile(Options options);
  /** The result of a job; the options have the files. */
  ResultFile(const MeshJob& job, Options options);

  /**
   * Chooses the order of the result. To be called before the work.
   * @param mesh the mesh, whose original numbers are read if no conversion tells them
   * @param conversion of the file of the mesh; null if that is a .vsm file
   * @throws Error if the format cannot hold such a mesh, or the mesh cannot be read; Cancelled
   */
  void chooseOrder(const StoredMesh& mesh, const ConversionReport* conversion,
    const ProgressFunction& progress = {});

  const std::filesystem::path& path() const { return this->Files.out; }
  /** Whether write() writes the file of the mesh again, with other positions. */
  bool rewritesInput() const { return this->Order == WrittenOrder::Rewritten; }
  /** Whether the result has the vertices of the file of the mesh in their order. */
  bool keepsOrder() const { return this->Order != WrittenOrder::Stream; }

  /** Writes the mesh with its result, a stream with all columns of `mesh`, in at most `memory`
   * bytes. Returns notes for the user. */
  std::vector<std::string> write(const StoredMesh& mesh, MeshSource& result, std::int64_t memory,
    const ProgressFunction& progress) const;

  /** The order that chooseOrder() is expected to choose, for a mesh like `mesh`. Of the original
   * numbers in a .vsm file it reads a few blocks only. */
  WrittenOrder expectedOrder(const StreamInfo& mesh) const;

  /** Notes for the user on the conversion of the file of the mesh, for the result of a job. */
  std::vector<std::string> notesOn(const ConversionReport& conversion, const MeshJob& job) const;

private:
  /** The kind of the file of the mesh. */
  MeshFileKind kindOfMesh() const;
  /** The suffixes that the result may have; `cells`: of the mesh, if they are known. */
  std::string choices(std::optional<CellType> cells = {}) const;
  /** Whether the format of the result can have the order of its original file and the columns. */
  bool restoresColumns() const;
  /** Whether the file of the mesh can be written again with other positions. */
  bool mayRewrite() const;
  /** Whether the format of the result and the kind of the mesh allow to restore the order. */
  bool mayRestore() const;
  /** The order, if `arePlaces` says whether the mesh has original numbers that are places in a
   * file. */
  WrittenOrder orderIf(const std::function<bool()>& arePlaces) const;
  std::vector<std::string> writeRestored(const StoredMesh& mesh, MeshSource& result,
    std::int64_t memory, const ProgressFunction& progress) const;
  /** The threads that write in at most `memory` bytes: one if that is little. */
  int threads(std::int64_t memory) const;

  Options Files;
  WrittenOrder Order = WrittenOrder::Stream;
};

} // namespace smg
