// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/OpenValues.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Labels of the vertices of a mesh stream, such that a cell lies in one patch if and only if the
 * labels of its corners are equal. The label of a vertex that is in no patch is NaN, which equals
 * nothing.
 *
 * If the cells have the column, the label of every vertex in a patch is 0: the corners of a cell
 * that are in some patch are all in the patch of the cell.
 */
class PatchLabels
{
public:
  /** Throws Error if there is no such column or it has several components. */
  PatchLabels(const std::string& column, MeshColumns& columns);

  /** To be called with all blocks of the stream and followed by endPreparing(): writes an unnamed
   * scratch file of one bit a vertex if the column is one of the cells. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  void endPreparing();

  /** Reads the labels of the vertices of a block; the first block begins anew. Throws Error if a
   * value of the column is not a number. */
  void read(const MeshBlock& block, std::span<double> labels);

  /** Accounts for what is kept of open vertices. */
  Pool& memory() const { return this->Columns.memory(); }
  /** The columns that read() needs. */
  std::vector<std::string> vertexColumns() const;

private:
  /** The label in a row of the column. */
  double at(const Column& column, std::size_t row, const MeshBlock& block) const;
  void prepareCells(const MeshBlock& block);

  const MeshColumns& Columns;
  NamedColumn Patch;
  // Of a column of the cells:
  std::optional<VertexSetFile> Seam; ///< the vertices in no patch
  OpenValues<double> Labels;         ///< of the first cell of each open vertex; NaN: none so far
  OpenValues<std::uint8_t> OnSeam;
  std::int64_t Written = 0, Known = 0; ///< numbers of vertices: in the file, and added
  std::vector<std::uint8_t> Bits;
};

/** The patch and the values of each open vertex of a mesh stream, that is, one that a later cell
 * may use. */
class PatchedValues
{
public:
  /** `columns`: values per vertex. */
  PatchedValues(PatchLabels& labels, int columns)
    : Patches(labels)
    , Labels(labels.memory())
    , Values(labels.memory(), columns)
  {
  }

  /** Starts the next block; the first block begins anew. Returns room for the values of its
   * vertices, which the caller sets. */
  std::span<double> startBlock(const MeshBlock& block)
  {
    this->Patches.read(block, this->Labels.startBlock(block));
    return this->Values.startBlock(block);
  }

  /** The values of an open vertex. */
  const double* at(std::int64_t vertex) const { return this->Values.at(vertex); }

  bool inOnePatch(std::int64_t a, std::int64_t b) const
  {
    return *this->Labels.at(a) == *this->Labels.at(b);
  }
  /** Whether a cell with these corners is in one patch. */
  bool inOnePatch(std::span<const std::int64_t> corners) const
  {
    bool is = true;
    for (const std::int64_t corner : corners)
    {
      is = is && this->inOnePatch(corners[0], corner);
    }
    return is;
  }

private:
  PatchLabels& Patches;
  OpenValues<double> Labels, Values;
};

} // namespace smg
