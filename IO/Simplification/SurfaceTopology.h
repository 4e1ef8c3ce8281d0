// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Poll.h"
#include "IO/Simplification/SurfaceParts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The triangles of a surface whose vertices move onto neighbours, in passes. Within a pass no
 * vertex goes that another one came to, or the other way round, so the triangles of a vertex are
 * those at the beginning of the pass, with their corners where they have gone.
 *
 * A move keeps the topology if the two vertices have no common neighbours but the corners opposite
 * to their edge, and are not two of the four vertices of a tetrahedron; at the boundary, if they
 * move along it (the link condition of Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving
 * edge contraction, 1999). Vertices whose triangles are not one fan, and those of very many
 * triangles, may not go. Edges of three or more triangles are curves as the boundary is: a triangle
 * that is all of a sheet between two such curves stays.
 *
 * Held vertices (SurfacePart::isHeld()) stay, with triangles. Borders between labels are kept as
 * boundaries are, until releaseBorders(): a vertex on one moves along it, and one where several
 * meet does not go. So no label vanishes, and none comes apart. So are joined seams (joinSeams()):
 * all vertices at a place of one move together, each along its own side.
 */
class SurfaceTopology
{
public:
  /** `part`: the triangles, which moves change. `open`: of each vertex, not 0 if it may have
   * more triangles elsewhere: it does not go. All must outlive this. */
  SurfaceTopology(SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll);

  std::size_t vertices() const { return this->Open.size(); }
  /** Whether a vertex may have more triangles elsewhere. */
  bool isOpen(std::uint32_t v) const { return this->Open[v] != 0; }
  /** Whether a vertex may go somewhere. */
  bool mayGo(std::uint32_t v) const { return this->IsFixed[v] == 0; }
  /** Whether the triangles at an edge have different labels; false if both ends are open. To be
   * called at the beginning of a pass. */
  bool isBorder(std::uint32_t a, std::uint32_t b) const
  {
    return (this->Curves[a] & this->Curves[b] & OnBorder) != 0 &&
           !(this->Open[a] != 0 && this->Open[b] != 0) &&
           (this->isLarger(a, b) ? this->isCurve(b, a) : this->isCurve(a, b));
  }
  /** Whether borders between labels are kept. */
  bool keepsBorders() const { return this->KeepsBorders; }
  void releaseBorders();
  /** Whether an edge may have a single triangle; false if it certainly has two. */
  bool mayBeBoundary(std::uint32_t a, std::uint32_t b) const
  {
    return (this->Curves[a] & this->Curves[b] & OnBoundary) != 0;
  }
  /** Whether two triangles run along some edge in the same direction. */
  bool isTurned() const { return this->IsTurned; }
  /** Whether an edge certainly has one triangle, counting those elsewhere. To be called at the
   * beginning of a pass. */
  bool isBoundary(std::uint32_t a, std::uint32_t b) const
  {
    return this->mayBeBoundary(a, b) && !(this->Open[a] != 0 && this->Open[b] != 0) &&
           (this->isLarger(a, b) ? this->hasOneTriangle(b, a) : this->hasOneTriangle(a, b));
  }

  /** The triangles of a vertex in this pass. */
  std::span<const std::uint32_t> star(std::uint32_t v) const
  {
    return { this->Stars.data() + this->Begin[v], this->Begin[v + 1] - this->Begin[v] };
  }
  /** The two corners of a triangle that follow its corner v, where they have gone. */
  std::array<std::uint32_t, 2> others(std::uint32_t triangle, std::uint32_t v) const
  {
    const std::uint32_t* c = this->Corners.data() + 3 * std::size_t(triangle);
    const int k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    return { this->Target[c[(k + 1) % 3]], this->Target[c[(k + 2) % 3]] };
  }

  /** Whether neither vertex has moved, or been moved to, in this pass. */
  bool areUntouched(std::uint32_t a, std::uint32_t b) const
  {
    return (this->Touched[a] | this->Touched[b]) == 0;
  }
  /** What moving a vertex onto a neighbour does to the topology. */
  enum class Change
  {
    None,
    Loop,      ///< it closes loops of three edges that bound no triangle
    Sheet,     ///< the triangle at the edge is all of a sheet at an edge of three or more triangles
    Vanishing, ///< the body is a tetrahedron, of which nothing would be left
    Impossible ///< the vertex may not go there
  };
  Change changeBy(std::uint32_t from, std::uint32_t to);
  void move(std::uint32_t from, std::uint32_t to);
  /** The squared distance of a vertex of the boundary from the boundary edge that replaces it when
   * it moves along the boundary; 0 of other vertices. */
  double fromBoundary(std::uint32_t from, std::uint32_t to) const;

  /** Whether one of some triangles of v would turn by too much, or collapse, if v were at `to`;
   * those that disappear if v moves there do not count. After letTurn(): false. */
  bool turn(std::span<const std::uint32_t> triangles, std::uint32_t v, std::uint32_t to) const;
  bool mayTurn() const { return this->MayTurn; }
  void letTurn() { this->MayTurn = true; }
  /** Ends a pass: removes the triangles that have collapsed. */
  void endPass();

private:
  friend class LoopCuts;

  /** Of an edge to a vertex of very many triangles, the other end has few. */
  bool isLarger(std::uint32_t a, std::uint32_t b) const
  {
    return this->star(a).size() > this->star(b).size();
  }
  void findStars();
  void classify(std::uint32_t v);
  std::size_t curvesAt(std::uint32_t v);
  bool isCurve(std::uint32_t v, std::uint32_t w) const;
  /** The place of the corner of a triangle that is neither of two others, where they have gone. */
  std::size_t third(std::size_t triangle, std::uint32_t v, std::uint32_t w) const
  {
    const std::uint32_t* c = this->Corners.data() + 3 * triangle;
    const auto isOther = [&](std::size_t k)
    { return this->Target[c[k]] != v && this->Target[c[k]] != w; };
    return isOther(0) ? 0 : isOther(1) ? 1 : 2;
  }
  /** The groups of the edge of a triangle between two of its corners, as this one has them. */
  GroupSet edgeSet(std::size_t triangle, std::uint32_t v, std::uint32_t w) const
  {
    return this->Part.edgeGroups ? this->Part.edgeSet(triangle, this->third(triangle, v, w))
                                 : GroupSet(0);
  }
  void carryEdges(std::uint32_t from, std::uint32_t to);
  bool areAlike(std::size_t one, std::size_t other, std::uint32_t v, std::uint32_t w) const;
  bool isUniform(std::span<const std::uint32_t> star) const;
  std::uint32_t& wedgeAt(std::size_t triangle, std::uint32_t v) const;
  bool findMoves(std::uint32_t from, std::uint32_t to);
  bool crossesBorders(std::uint32_t from, std::uint32_t to) const;
  bool isFan();
  std::size_t trianglesAt(std::uint32_t v, std::uint32_t w) const;
  bool hasOneTriangle(std::uint32_t v, std::uint32_t w) const
  {
    return this->trianglesAt(v, w) == 1;
  }
  bool isTetrahedron(std::uint32_t from, std::uint32_t to, const std::uint32_t* opposite) const;

  SurfacePart& Part;
  const std::vector<std::uint32_t>& Corners;
  std::span<const std::uint8_t> Open;
  const Poll& Polled;
  /** For each vertex whether it may not go: bits. */
  enum : std::uint8_t
  {
    ByTopology = 1,
    ByBorders = 2,
    ByHold = 4
  };
  /** The curves that a vertex is on: bits. */
  enum : std::uint8_t
  {
    OnBoundary = 1,
    OnBorder = 2 ///< between labels
  };
  std::vector<std::uint8_t> IsFixed, Curves;
  bool KeepsBorders = false;
  bool IsTurned = false;
  bool MayTurn = false;
  // Of a pass.
  std::vector<std::uint32_t> Begin, Stars; ///< the triangles of each vertex
  std::vector<std::uint32_t> Target;       ///< where a vertex has gone
  std::vector<std::uint8_t> Touched;       ///< 0, or what has moved a vertex, or others to it
  static constexpr std::uint8_t ByMove = 1, ByCut = 2;
  // Marks of vertices, valid where they are the last one.
  std::uint32_t Mark = 0;
  std::vector<std::uint32_t> Seen, Common;
  /** The other corners of the triangles of a star; or each with one of its triangles; or the
   * vertices of a seam, each with the one that it moves onto. */
  std::vector<std::array<std::uint32_t, 2>> Pairs;
  std::vector<std::uint32_t> Across;       ///< after Change::Loop: the third vertices of the loops
  std::array<std::uint32_t, 2> Opposite{}; ///< of the last edge that was looked at
};

} // namespace smg
