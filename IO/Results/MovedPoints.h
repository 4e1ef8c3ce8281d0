// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "Solver/Core/Vector.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/MovedMesh.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * Finds the cells of a stream that a motion of its vertices inverts (Report::Inverted): cells
 * without weight, and cells that are flat at rest within the rounding of their coordinates, are
 * left out. Stores the vertices that are not final. The result does not depend on the blocks.
 */
class SMG_EXPORT InvertedCells
{
public:
  /** At most `memory` bytes are in memory; the rest is in a scratch file in `scratch` (empty: the
   * system's temporary folder). */
  InvertedCells(const StreamInfo& info, const std::filesystem::path& scratch, std::int64_t memory);

  /** Adds the next block with its vertices moved; `rest` are their positions at rest. */
  void add(std::span<const double> rest, const MeshBlock& moved);
  /** What was found so far, without the share. */
  const Report::Inverted& found() const { return this->Found; }
  /** Adds what was found in another part of the mesh. Of equally bad cells, the worst stays. */
  void join(const Report::Inverted& other);
  /** After the last block: adds what was found to the report, with a note if it is anything. */
  void finish(Report& report) const;

private:
  /** The position of a vertex, at rest and moved. */
  struct Place
  {
    Vector rest, moved;
    std::array<double, 2> unused; ///< to a power of two
  };
  using Corners = std::array<Place, 4>;

  std::optional<double> ratio(const Corners& corners) const;
  void judge(const Corners& corners, const MeshBlock& block, std::size_t cell);

  StreamInfo Info;
  double Rounding;          ///< of coordinates, relative
  PagedArray<Place> Places; ///< by stream index
  std::int64_t Cells = 0;   ///< so far
  Report::Inverted Found;
};

/** A mesh stream with the positions of a solution of three columns, rounded to the precision of the
 * stream. The bounds of its info are unknown. */
class SMG_EXPORT MovedPoints : public MeshSource
{
public:
  /** The positions must outlive this object, and so must `report`, if it is given: at the end of
   * the stream, it gets the cells that the motion inverts (see InvertedCells, with `options`). */
  MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions, Report* report = nullptr,
    const NormalsOptions& options = {});

  const StreamInfo& info() const override { return this->Info; }

  /** Throws Error if a position is not finite in the stream's precision. */
  bool next(MeshBlock& block) override;

private:
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
  Solution& Positions;
  Report* Judged;
  std::optional<InvertedCells> Inverted; ///< until the end of the stream, if there is a report
  std::vector<double> Rest;              ///< positions of a block
};

} // namespace smg
