// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/AddedColumns.h"
#include "IO/Arrays/ArrayView.h"
#include "IO/Arrays/OriginalOrder.h"
#include "smg/Export.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** Which blocks of a mesh to read. */
struct MeshBlocksOptions
{
  std::int64_t points = 1000000; ///< the most vertices of a block, at least 4
  std::optional<std::vector<std::string>> vertexColumns = {}; ///< none: all
  std::optional<std::vector<std::string>> cellColumns = {};   ///< none: all
  std::string fingerprint = {}; ///< StoredMesh::fileFingerprint(); empty: any file
};

/** A mesh in blocks of consecutive cells with all their vertices, at most so many, as arrays. */
class SMG_EXPORT MeshBlocks
{
public:
  /**
   * @param file the .vsm file
   * @param order the original order of its mesh
   * @param added the same mesh with added columns; null: there are none
   * @throws ArgumentError if a column does not exist or the number of points is out of range; Error
   */
  MeshBlocks(const std::filesystem::path& file, std::shared_ptr<const OriginalOrder> order,
    std::shared_ptr<const AddedColumns> added, const MeshBlocksOptions& options);

  /** Goes to the next block; returns false at the end. */
  bool next();
  std::int64_t vertices() const { return this->Piece.vertices(); }
  std::int64_t cells() const { return this->CellCount; }

  // Arrays of the block, until next().

  /** The rows of its vertices or cells in the original order, int64. */
  ArrayView rows(bool ofCells) const;
  /** Which of its vertices an earlier block has, too: 1, else 0; uint8. */
  ArrayView ghosts() const;
  /** "Position" and columns of the vertices, "Corners" (rows of the block) and columns of the
   * cells. Throws ArgumentError. */
  ArrayView array(bool ofCells, const std::string& name) const;

private:
  /** Of the vertices or of the cells. */
  struct Part
  {
    std::vector<const AddedColumns::Added*> added;
    std::vector<std::int64_t> rows;
    std::vector<Column> columns; ///< the added ones
  };

  void choose(bool ofCells, const std::optional<std::vector<std::string>>& names, Part& part,
    std::vector<std::string>& stored);
  void read();
  void complete(bool ofCells, Part& part);

  VsmReader Reader;
  std::shared_ptr<const OriginalOrder> Order;
  std::shared_ptr<const AddedColumns> Added;
  std::int64_t Points;
  Part OfVertices, OfCells;
  MeshPiece Piece;
  std::int64_t NextCell = 0, CellCount = 0, Guess = 1;
};

} // namespace smg
