// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Poll.h"
#include "IO/Simplification/SurfaceParts.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Finds the vertices along seams of a stream of triangles: those of the boundary that lie at one
 * place with others of the boundary, as on both sides of a seam between patches with vertices of
 * their own. Where there are too many, a sample of the places is remembered, chosen by a hash of
 * the coordinates, so that coincident vertices are chosen together. */
class SeamVertices
{
public:
  /** A vertex of a seam, and the number of vertices at its place, at least 2. */
  struct Seam
  {
    std::int64_t vertex;
    std::int64_t atPlace;
  };

  /** `memory`: about the bytes to remember vertices in; accounted for in `pool`. */
  SeamVertices(Pool& pool, std::int64_t memory);

  /** Adds the next block of the stream. */
  void add(const MeshBlock& block);
  /** To be called after the last block. */
  void finish();

  /** The number of places where several vertices lie; an estimate unless isExact(). */
  std::int64_t places() const;
  bool isExact() const { return this->Shift == 0; }
  /** The vertices of seams that are remembered, ascending: all if isExact(). */
  std::vector<Seam> seams() const;

private:
  struct Point
  {
    std::uint64_t place;
    std::int64_t vertex;
  };

  void close(std::int64_t final);
  bool isChosen(std::uint64_t place) const
  {
    return (place & ((std::uint64_t(1) << this->Shift) - 1)) == 0;
  }
  void thin();

  OpenValues<std::uint64_t> Open; ///< of each open vertex: its fan, see add(), and its place
  Reservation Reserved;
  std::size_t Most;
  std::vector<Point> Boundary; ///< after finish(): sorted by places
  std::int64_t Shift = 0;      ///< of 2^Shift places, one is remembered
  std::int64_t Final = 0, Vertices = 0;
};

/** Joins the vertices of a part that lie at one place of a seam, if all of that place are in the
 * part, none is open, and at most one is held: corners refer to one of them, and
 * SurfacePart::wedges to their own. */
void joinSeams(SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll = Poll());

/** Gives the triangles of all sides, at places that joinSeams() has joined, one vertex with the
 * columns of one side, until so many vertices have no triangles more. Returns how many these are.
 */
std::size_t weldSeams(SurfacePart& part, std::size_t most, const Poll& poll = Poll());

/** Undoes joinSeams() after collapses: corners are vertices of their own again, those of places
 * that have gone are used by none. One vertex of each place has its quadric, and all of them know
 * how many are left there. */
void separateSeams(SurfacePart& part);

/** For each vertex of a part, which is not joined, 1 if it is held, or lies on a seam of which it
 * has not all vertices, or an open one; else 0. */
std::vector<std::uint8_t> heldVertices(
  const SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll = Poll());

/** From here on, a part has no seams, only boundaries. */
void forgetSeams(SurfacePart& part, const Poll& poll = Poll());

} // namespace smg
