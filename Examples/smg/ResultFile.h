// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "IO/Formats/FormatTable.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** The file OUT of a command: the mesh of the file IN with a result, in the order of IN wherever
 * the format can have it. */
class ResultFile
{
public:
  /** The files, how OUT is written, and what it has. */
  struct Options
  {
    std::filesystem::path in, out, scratch;
    /** Whether points of IN are merged, so that the order of its points is not known. */
    bool welds = false;
    /** The columns of the result, for an error, for example "a solution"; empty if the result is IN
     * with other positions. */
    std::string columns;
    /** The names of these columns, of the vertices, if IN has them. */
    std::vector<std::string> changed = {};
    int threads = 0; ///< that write; 0: one per core
  };

  /** Throws smg::Error if the name of OUT is invalid. */
  explicit ResultFile(Options options);

  /**
   * Chooses the order of OUT. To be called before the work.
   * @param mesh the mesh of IN
   * @param conversion of IN; null if that is a .vsm file
   * @throws smg::Error if OUT cannot hold such a mesh
   */
  void chooseOrder(const smg::VsmReader& mesh, const smg::ConversionReport* conversion);

  /** Whether write() writes the file IN again, with other positions. */
  bool rewritesInput() const { return this->Order == smg::WrittenOrder::Rewritten; }
  /** Whether OUT has the vertices of the mesh file IN in their order. */
  bool keepsOrder() const { return this->Order != smg::WrittenOrder::Stream; }

  /** Writes the mesh with its result, a stream with all columns of `mesh`, in at most `memory`
   * bytes. Returns notes for the user. */
  std::vector<std::string> write(const smg::VsmReader& mesh, smg::MeshSource& result,
    std::int64_t memory, const smg::ProgressFunction& progress) const;

  /** The order that chooseOrder() is expected to choose, for a mesh like `mesh`. */
  smg::WrittenOrder expectedOrder(const smg::StreamInfo& mesh) const;

private:
  /** The suffixes that OUT may have; `cells`: of the mesh, if they are known. */
  std::string choices(std::optional<smg::CellType> cells = {}) const;
  /** Whether the format of OUT can have the order of its original file and the columns. */
  bool restoresColumns() const;
  /** Whether IN can be written again with other positions. */
  bool mayRewrite() const;
  /** Whether the format of OUT and the kind of IN allow to restore the order. */
  bool mayRestore() const;
  std::vector<std::string> writeRestored(const smg::VsmReader& mesh, smg::MeshSource& result,
    std::int64_t memory, const smg::ProgressFunction& progress) const;
  /** The threads that write in at most `memory` bytes: one if that is little. */
  int threads(std::int64_t memory) const;

  Options Files;
  smg::WrittenOrder Order = smg::WrittenOrder::Stream;
};
