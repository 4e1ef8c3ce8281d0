// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/SharedPoints.h"
#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"

#include "vtkStreamingMultigridIOModule.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkPointSet;

namespace smg
{

class PieceInput;

/** In how many pieces an input is requested: a given number, or one for which pieces are small. */
struct VTKSTREAMINGMULTIGRIDIO_EXPORT PieceCount
{
  static constexpr int Usual = 64;
  static constexpr int Most = 1000000;

  int given = 0;                                            ///< 0: chosen
  std::int64_t pieceBytes = std::int64_t(64) * 1024 * 1024; ///< most of a VTK data object
  int least = Usual;                                        ///< the smallest number that is chosen

  /** `given` pieces; 0: as many as a program with this memory limit (bytes) can afford. */
  static PieceCount within(int given, std::int64_t memoryLimit);

  /** The number for an input whose pieces have not been seen: from the size of its mesh, if it is
   * that of a .vsm file; else Usual. */
  int first(PieceInput& input) const;

  /** The layers of ghost cells that pieces have for the filters before (PieceInput::ghostLevels()):
   * none if they may take more than half of a piece. */
  int ghostLevels(PieceInput& input, int pieces) const;

  /** The number for an input of which this is one of `pieces` pieces. */
  int enough(int pieces, vtkDataObject& piece) const;
};

/** The point and cell arrays of the pieces that become columns of the mesh stream. */
struct PieceColumns
{
  bool all = false; ///< every named numeric array
  /** Otherwise the arrays of these names, each of which the points or the cells must have, */
  std::set<std::string> required;
  std::set<std::string> optional; ///< and the existing arrays of these names
};

/**
 * Requests the pieces 0, 1, ... of an input once, in order, as the blocks of a mesh stream, and
 * checks the piece contract: point GlobalIds are stream indices; the points that are not marked as
 * duplicates in vtkGhostType continue the range [0, n) of the previous pieces without a gap; the
 * cells, which are triangles or tetrahedra, use every point, and the points are numbered by first
 * use. Duplicate cells are omitted. A block is a piece; blocks without points and cells are
 * omitted.
 *
 * The counts are known only at the end: before, only cellType, doublePositions and the columns of
 * info() are valid.
 */
class VTKSTREAMINGMULTIGRIDIO_EXPORT PieceStream
{
public:
  /** Reads up to the first non-empty piece; begins again with more pieces if that is larger than
   * `pieces` allows. Throws Error. */
  PieceStream(PieceInput& input, const PieceCount& pieces, PieceColumns columns);

  const StreamInfo& info() const { return this->Info; }

  /** Fills `block` with the next piece; returns false at the end. Throws Error. */
  bool next(MeshBlock& block);

  /**
   * The same, and returns the piece, which keeps its data until the next call; nullptr at the end.
   */
  vtkPointSet* nextPiece(MeshBlock& block);

  int pieces() const { return this->Pieces; }
  /** The fraction of the pieces that have been read, 0 to 1. */
  double fraction() const { return double(this->NextPiece) / this->Pieces; }

private:
  vtkPointSet* pull();
  void learn(vtkPointSet& piece);
  void convert(vtkPointSet& piece, MeshBlock& block);
  std::vector<std::int64_t> ownPoints(
    vtkPointSet& piece, const std::vector<std::int64_t>& ids) const;
  /** Throws Error unless this piece or an earlier one owns the point; all these are below `end`. */
  void requireOwned(std::int64_t id, std::int64_t end) const;
  void copyPoints(vtkPointSet& piece, const std::vector<std::int64_t>& own, MeshBlock& block) const;
  void copyCells(vtkPointSet& piece, const std::vector<std::int64_t>& ids, MeshBlock& block) const;
  void useCorners(const std::vector<std::int64_t>& corners);
  void noteFinalized(vtkPointSet& piece, const std::vector<std::int64_t>& ids);
  void checkEnd() const;
  std::string where() const;

  PieceInput& Input;
  int Pieces;
  int NextPiece = 0;
  PieceColumns Columns;
  bool IsFiltered; ///< by filters of others, which may compute from neighbours
  int GhostLevels; ///< that pieces have for these
  StreamInfo Info;
  vtkPointSet* First = nullptr; ///< read by the constructor
  bool IsHeld = false;          ///< whether the input holds the data of the last piece
  std::int64_t Vertices = 0, Cells = 0;
  std::int64_t Used = 0;    ///< vertices that cells have used
  std::deque<char> IsFinal; ///< from the first vertex that is not final
  std::int64_t Finalized = 0;
  SharedPoints Shared; ///< to find out whether they need more
};

/** The array of GlobalIds of the points: the attribute, or else the array of that name; or null. */
VTKSTREAMINGMULTIGRIDIO_EXPORT vtkDataArray* globalIdArray(vtkPointSet& piece);

/** The GlobalIds of the points of a piece. Throws Error, which begins with `where`, if there are
 * none. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> globalIdsOf(
  vtkPointSet& piece, const std::string& where);

/**
 * Writes the whole stream to the container `path` (see VsmWriter), with fast compression if
 * `forScratch`. `isolatedFrom` is a .vsm file whose vertices of no cell are copied (see
 * copyIsolated()) with the fingerprint that it must have; empty: none. Throws Error and Cancelled;
 * no file is left then.
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT StreamInfo writeContainer(PieceStream& stream,
  const std::filesystem::path& path, bool forScratch, Progress& progress,
  const std::filesystem::path& isolatedFrom = {}, const std::string& fingerprint = {});

} // namespace smg
