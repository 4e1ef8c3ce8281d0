// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Files/BlockStore.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/**
 * How the triangles of a surface are to be wound, found in one reading of its stream: alike within
 * each body, and outwards if it is closed. A body is connected by edges of exactly two triangles.
 * Of an open body the fewer triangles are turned; a closed one that is wound inwards, but lies
 * within the bounds of another one, may be a cavity, and stays as it is; so does one that has no
 * sides, as a Moebius strip.
 */
class SMG_EXPORT Orientation
{
public:
  /** Files are unnamed, in `folder`; empty: the system's temporary folder. */
  Orientation(Pool& pool, const std::filesystem::path& folder);

  /** Adds the next block. */
  void add(const MeshBlock& block);
  /** To be called after the last block. */
  void finish();

  // Afterwards:

  std::int64_t cells() const { return this->Cells; }
  /** The triangles that are to be turned. */
  std::int64_t turned() const { return this->Turned; }
  /** The bodies that have no sides. */
  std::int64_t unorientable() const { return this->Unorientable; }
  /** Whether all bodies are closed. */
  bool isClosed() const { return this->OpenBodies == 0; }
  /** The volume that closed bodies enclose, wound like that; of cavities it is negative. */
  double volume() const { return this->Volume; }
  /** The volume of the cavities among them, positive. */
  double cavities() const { return this->Cavities; }

  /** Reads which of the cells [first, first + marks.size()) are to be turned: 1, else 0. */
  void read(std::int64_t first, std::span<std::uint8_t> marks);

private:
  static constexpr std::int64_t BlockCells = std::int64_t(1) << 16;

  /** How the cells of a set are wound, beside the one that represents it. */
  struct Sums
  {
    double volume; ///< six times that of the triangles, wound like the representing one
    std::int64_t cells, opposite; ///< all, and those wound the other way in the mesh
    std::int64_t boundary;        ///< edges of one triangle
    std::int64_t contradictions;  ///< edges whose triangles cannot be wound alike
    std::array<double, 3> low, high;
  };
  /** A triangle with open edges. */
  struct Member
  {
    std::uint32_t up; ///< distance to a later triangle of its set; 0: the last, which represents it
    std::uint8_t opposite; ///< 1: wound the other way than that
    std::uint32_t reach;   ///< its second corner in ascending order, by low 32 bits
    Sums sums;             ///< of the set that it represents
  };
  /** The triangles at an edge. */
  struct Edge
  {
    std::uint32_t cell[2];   ///< low 32 bits
    std::uint8_t ascends[2]; ///< whether the triangle runs along it from the lower vertex on
    std::uint8_t count;      ///< of triangles; 3: more than two
  };
  /** What becomes of a cell: as the one this far ahead, perhaps opposite; or, the representing one
   * of a body, by itself. */
  struct Link
  {
    std::uint32_t up;
    std::uint32_t state; ///< 1: opposite; of a representing cell 0, 1: to be turned, or Leave
  };
  /** A body that is closed, or open and large enough to have cavities. */
  struct Body
  {
    std::int64_t cell; ///< that represents it
    double volume;     ///< sixfold, wound like that
    bool isClosed, mayBeCavity;
    std::array<double, 3> low, high;

    bool contains(const Body& other) const;
  };
  static constexpr std::uint32_t Leave = 2;

  struct Root
  {
    std::int64_t cell;
    std::uint8_t opposite; ///< of the cell that was asked for
  };

  void addCell(const std::int64_t* corners, unsigned flags);
  void addEdge(std::int64_t a, std::int64_t b, std::int64_t cell);
  void finishVertices(std::int64_t end);
  void relate(const Edge& edge);
  void closeCells(std::int64_t finalized, bool all);
  std::uint32_t closeBody(std::int64_t cell, const Sums& sums);
  Root find(std::int64_t cell);
  std::int64_t cellOf(std::uint32_t low) const;
  void write(Link link);
  void flush();
  void keepBody(std::int64_t cell, const Sums& sums);
  void decideCavities();
  void resolve();

  Pool& Memory;
  Ring<double> Points;
  OpenFacets Open; ///< the edges, by their places in Edges
  Slots<Edge> Edges;
  Ring<Member> Members; ///< triangles
  BlockStore Links, Marks;
  IoStatistics Traffic;
  Reservation Kept;
  std::vector<Link> Written; ///< of the current block
  std::vector<Body> Bodies;
  std::vector<std::int64_t> TurnedBodies; ///< representing cells of closed bodies, ascending
  std::array<double, 3> Origin{};
  std::int64_t Cells = 0, Final = 0, Block = 0; ///< Block: of links, the next
  std::int64_t Turned = 0, Unorientable = 0, OpenBodies = 0;
  std::uint32_t Longest = 0; ///< of the links
  double Volume = 0.0, Cavities = 0.0;
};

} // namespace smg
