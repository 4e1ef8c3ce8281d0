// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"
#include "IO/Simplification/SurfaceTopology.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/**
 * Changes of the topology of a surface that leave it manifold and wound as it is: handles and bumps
 * are cut along loops of three edges that bound no triangle, holes of three edges are closed,
 * bodies of four triangles go, and sheets of one triangle at an edge of three or more.
 *
 * Where two neighbours a and b have a common neighbour c without a triangle between them, moving a
 * onto b would leave four triangles at the edge to c. If both sides of the loop a, b, c meet
 * nearby, it goes around a handle: the surface is cut along it, and both rims are closed. On the
 * near side b moves onto a, on the far side a onto b, and on the near side another vertex takes the
 * place of c: one that has collapsed onto it before, so that each vertex is one of the mesh. If one
 * side has few vertices, they are a bump, and become the triangle of the loop. Else the loop is the
 * neck of two large parts, which are not separated.
 *
 * What such a change costs is the square of a distance, as the errors of collapses are: of a loop
 * the radius of the circle inside it, of a bump, of a body and of a sheet its size.
 */
class LoopCuts
{
public:
  /** What a pass over the edges of the surface has done. */
  struct Pass
  {
    std::size_t most = 0;           ///< vertices that may go
    std::size_t gone = 0, came = 0; ///< vertices
    std::size_t bodies = 0;         ///< that have gone
    double error = 0.0;             ///< squared, the largest one

    /** Whether there were changes that cost too much. */
    bool hasMore() const { return this->least < std::numeric_limits<float>::infinity(); }
    /** A limit of the costs with which the next pass can do more. */
    float nextLimit(float limit) const
    {
      return this->hasMore() ? std::max(4.0F * limit, this->least) : limit;
    }

    float least = std::numeric_limits<float>::infinity(); ///< cost of what cost too much
  };

  /** Of a surface no vertex of which has moved. `scale` makes ranks of squared lengths. */
  LoopCuts(SurfacePart& part, SurfaceTopology& surface, double scale);

  /** Notes that a vertex has moved onto another one. */
  void addGone(std::uint32_t from, std::uint32_t to)
  {
    std::swap(this->Gone[from], this->Gone[to]);
  }

  enum class Done
  {
    Nothing,
    Cut,
    Hole ///< the loop is a hole that the move closes: closeHole()
  };
  /** Changes the topology at an edge where a move would close loops (SurfaceTopology::changeBy()),
   * if the costs, and the rank of the edge, are at most `limit`. */
  Done cut(std::uint32_t from, std::uint32_t to, float rank, float limit, Pass& pass);
  /** To be called after the move. */
  void closeHole(std::uint32_t to);
  /** Removes the tetrahedron with an edge, if its size is at most `limit`. Returns whether it has
   * gone. */
  bool removeBody(std::uint32_t from, std::uint32_t to, float limit, Pass& pass);
  /** Whether the triangle at an edge, which is or may be all of a sheet, may go by the move: if it
   * is none, or reaches at most `limit` away from the edge where it is attached. */
  bool mayRemoveSheet(std::uint32_t from, std::uint32_t to, float limit, Pass& pass) const;

private:
  enum class Kind
  {
    Handle,
    Bump,
    Neck
  };
  enum class Met
  {
    Nothing,
    OtherSide,
    Cut ///< a cut of this pass
  };
  /** The triangles around the three vertices of a loop, on one side of it. */
  struct Side
  {
    std::vector<std::uint32_t> from, to, across;
  };
  /** The loop that is looked at. */
  struct Loop
  {
    std::uint32_t from = 0, to = 0, across = 0;
  };

  double squaredDistance(std::uint32_t a, std::uint32_t b) const
  {
    const Vector way = difference(this->Part.point(a), this->Part.point(b));
    return dot(way, way);
  }
  double costOf(const Loop& loop) const;
  Loop leastLoop(std::uint32_t from, std::uint32_t to) const;
  /** Whether a vertex that was not touched has one closed fan of triangles, of one label and on no
   * seam, and may go. */
  bool isPlain(std::uint32_t v) const
  {
    return this->Surface.IsFixed[v] == 0 && this->Surface.Curves[v] == 0 &&
           this->Surface.Touched[v] == 0 && this->Surface.Open[v] == 0 && this->Part.seamOf(v) == 0;
  }
  std::size_t trianglesOf(std::uint32_t v) const;
  bool isHole(const Loop& loop) const;
  bool walk(std::uint32_t v, std::uint32_t triangle, std::uint32_t start, std::uint32_t end,
    std::vector<std::uint32_t>& passed) const;
  void findRest(
    std::uint32_t v, const std::vector<std::uint32_t>& near, std::vector<std::uint32_t>& far) const;
  bool shareOne(const Side& side, const Loop& loop);
  bool findSides(const Loop& loop);
  Met spread(std::span<const std::uint32_t> triangles, bool isNear);
  Kind kindOf(const Loop& loop);
  bool cutHandle(const Loop& loop, Pass& pass);
  bool cutOff(const Loop& loop, float limit, Pass& pass);
  std::uint32_t takeGone(std::uint32_t v, std::uint32_t owner);
  void replace(std::span<const std::uint32_t> triangles, std::uint32_t v, std::uint32_t by);
  void replaceWedges(std::uint32_t v, std::uint32_t by);
  float rankOf(double cost) const { return static_cast<float>(cost * this->Scale); }
  static bool costsTooMuch(float rank, float limit, Pass& pass);

  SurfacePart& Part;
  SurfaceTopology& Surface;
  double Scale;
  /** For each vertex the next one in the ring of those that have gone where it has. */
  std::vector<std::uint32_t> Gone;
  Side Near, Far;
  /** The vertices around a loop on either side, those that are nearer to it first. */
  std::vector<std::uint32_t> NearVertices, FarVertices;
};

} // namespace smg
