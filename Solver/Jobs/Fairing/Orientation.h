// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Files/BlockStore.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Jobs/Fairing/WindingRays.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * How the triangles of a surface are to be wound: alike within each body, and outwards if it is
 * closed. A body is connected by edges of exactly two triangles. Of an open body the fewer
 * triangles are turned, and of one that ends at edges of more triangles. One that has no sides, as
 * a Moebius strip, stays as it is.
 *
 * Closed bodies that lie in others keep their winding relative to those: one that is wound against
 * what it lies in is a cavity, also where all of them are inside out. With w the winding number of
 * space, as the mesh is wound, a body is turned if the sum of w just outside it and just inside it
 * is negative. A body whose own triangles are not wound alike says nothing: it is wound outwards.
 *
 * Takes one reading of the stream, and a second one where winding numbers are needed.
 */
class SMG_EXPORT Orientation
{
public:
  /** Files are unnamed, in `folder`; empty: the system's temporary folder. */
  Orientation(Pool& pool, const std::filesystem::path& folder);

  using Visit = std::function<void(const MeshBlock& block)>;

  /** Finds it; `read` passes all blocks to its argument, once or twice. */
  void find(const std::function<void(const Visit& visit)>& read);

  // Afterwards:

  std::int64_t cells() const { return this->Cells; }
  /** The triangles that are to be turned. */
  std::int64_t turned() const { return this->Turned; }
  /** The bodies that have no sides. */
  std::int64_t unorientable() const { return this->Unorientable; }
  /** The bodies that end at edges of more than two triangles, and only there: what is outside of
   * them is not known. */
  std::int64_t branched() const { return this->Branched; }
  /** The closed bodies within others whose triangles were not wound alike, so that they may be
   * cavities. */
  std::int64_t ambiguous() const { return this->Ambiguous; }
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
    /** A hash of the edges at which they end, those of several triangles included: 0 if none. */
    std::uint64_t rim;
    bool hasBoundary;      ///< edges of one triangle
    bool hasContradiction; ///< an edge whose triangles cannot be wound alike
    std::array<double, 3> low, high;
    std::array<double, 2> farthest; ///< y and z of a point with x = high[0]
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
    bool isClosed;
    bool isAlike; ///< whether the mesh has its triangles wound alike
    std::array<double, 3> low, high;
    std::array<double, 2> farthest; ///< y and z of a point with x = high[0]

    bool isInwards() const { return this->isClosed && this->volume < 0.0; }
    bool contains(const Body& other) const;
  };
  /** States beside 1, to be turned: what has no sides, and what is not of a closed body. */
  static constexpr std::uint32_t Leave = 2, Open = 4;

  struct Root
  {
    std::int64_t cell;
    std::uint8_t opposite; ///< of the cell that was asked for
  };

  void add(const MeshBlock& block);
  void finish();
  void nest(const MeshBlock& block);
  void addCell(const std::int64_t* corners, unsigned flags);
  void addEdge(std::int64_t a, std::int64_t b, std::int64_t cell);
  void finishVertices(std::int64_t end);
  void relate(const Edge& edge);
  void closeCells(std::int64_t finalized, bool all);
  std::uint32_t closeBody(std::int64_t cell, const Sums& sums);
  Root rootOf(std::int64_t cell);
  std::int64_t cellOf(std::uint32_t low) const;
  void write(Link link);
  void flush();
  void keepBody(std::int64_t cell, const Sums& sums);
  bool mayNest() const;
  void beginNesting();
  void decide();
  void resolve();
  void readStates(std::int64_t first, std::span<std::uint8_t> states);

  Pool& Memory;
  Ring<double> Points{ this->Memory, 3 };
  OpenFacets OpenEdges{ this->Memory }; ///< by their places in Edges
  FreeList<Edge> Edges{ this->Memory };
  Ring<Member> Members{ this->Memory }; ///< triangles
  BlockStore Links, Marks;
  IoStatistics Traffic;
  Reservation Reserved{ this->Memory };
  std::vector<Link> Written; ///< of the current block
  std::vector<Body> Bodies;
  std::vector<std::int64_t> TurnedBodies; ///< representing cells of closed bodies, ascending
  std::optional<WindingRays> Rays;        ///< from the closed bodies, if they are needed
  std::array<double, 3> Origin{};
  std::int64_t Cells = 0, Final = 0, Block = 0; ///< Block: of links, the next
  std::int64_t Turned = 0, Unorientable = 0, Branched = 0, Ambiguous = 0;
  std::uint32_t Longest = 0; ///< of the links
  double Volume = 0.0, Cavities = 0.0;
};

} // namespace smg
