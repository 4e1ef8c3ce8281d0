// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Elements.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Mesh/OpenSets.h"
#include "Solver/Mesh/VisitCells.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The extent, the mean edge length and the bodies of a mesh, from one reading of its stream. A
 * body is connected by its cells: two cells that share a vertex are of one body. Of the lengths and
 * volumes, cells that are flagged or use a vertex twice are left out. */
class SMG_EXPORT MeshMeasures
{
public:
  /** `ofAllCells`: the volumes are those of flagged cells, too. */
  MeshMeasures(Pool& pool, CellType type, bool ofAllCells = false)
    : Type(type)
    , OfAllCells(ofAllCells)
    , Points(pool, 3)
    , Open(pool)
  {
  }

  /** Adds the next block. */
  void add(const MeshBlock& block);
  /** To be called after the last block. */
  void finish();

  /** The position of a vertex that was not final before the last block. */
  const double* point(std::int64_t vertex) const { return this->Points.at(vertex); }

  /** Least and greatest coordinates of the vertices; infinite without vertices. */
  const std::array<double, 3>& low() const { return this->Low; }
  const std::array<double, 3>& high() const { return this->High; }
  /** The diagonal of the bounds of the vertices; 0 without vertices. */
  double diagonal() const;
  /** The mean length of the edges of the cells, each counted for each of its cells; 0 without
   * cells. */
  double meanEdge() const;

  // After finish():

  std::int64_t bodies() const { return this->Bodies; }
  /** The cells of the body that has the most. */
  std::int64_t largestBody() const { return this->Largest; }
  /** Vertices of no cell. */
  std::int64_t isolated() const { return this->Isolated; }
  /** The volume that triangles enclose if they are closed and their normals point outwards. */
  double volume() const { return this->Volume; }
  /** The sum of the volumes of the bodies that are wound inside out, or are cavities of others. */
  double turnedVolume() const { return this->TurnedVolume; }

private:
  /** Of the cells of a body. */
  struct Body
  {
    std::int64_t cells;
    double volume; ///< six times that of its triangles

    Body& operator+=(const Body& other)
    {
      this->cells += other.cells;
      this->volume += other.volume;
      return *this;
    }
  };

  void addCell(const std::int64_t* corners, unsigned flags);
  void addLengths(const std::int64_t* corners);
  double sixfoldVolume(const std::int64_t* corners) const;
  void addBody(const Body& body);

  CellType Type;
  bool OfAllCells;
  Ring<double> Points;
  OpenSets<Body> Open;
  std::int64_t Bodies = 0, Largest = 0, Isolated = 0;
  double Volume = 0.0, TurnedVolume = 0.0;
  std::array<double, 3> Low{ Infinity, Infinity, Infinity };
  std::array<double, 3> High{ -Infinity, -Infinity, -Infinity };
  std::array<double, 3> Origin{}; ///< volumes are measured from here: the first vertex
  double Lengths = 0.0;
  std::int64_t Edges = 0;
  std::int64_t Finalized = 0; ///< after the previous block

  static constexpr double Infinity = std::numeric_limits<double>::infinity();
};

/** The tuples of a vertex file at the open vertices of a mesh stream. Blocks are passed in order;
 * the first block restarts it. */
class OpenTuples
{
public:
  OpenTuples(Pool& pool, const VertexFile& file)
    : File(&file)
    , Values(pool, file.lanes())
  {
  }

  /** Reads the tuples of the vertices of the next block. */
  void startBlock(const MeshBlock& block)
  {
    if (block.firstVertex == 0)
    {
      this->Values.restart();
      this->Finalized = 0;
    }
    this->Values.release(this->Finalized);
    this->Finalized = block.finalized;
    if (block.vertices() > 0)
    {
      this->Values.extendRaw(block.firstVertex + block.vertices());
      this->File->read(block.firstVertex, block.vertices(), this->Values.at(block.firstVertex));
    }
  }

  /** The tuple of an open vertex; those of the current block lie one after the other. */
  const double* at(std::int64_t vertex) const { return this->Values.at(vertex); }

private:
  const VertexFile* File;
  Ring<double> Values;
  std::int64_t Finalized = 0; ///< after the previous block
};

/** The unit normals at the vertices of a triangle mesh stream with other positions: normals of the
 * triangles, averaged with their angles at the vertex as weights. Triangles without area do not
 * count. Held vertices, and those that have no triangle with an area, get the normal 0. */
class PointNormals
{
public:
  /** Appends the normals of the vertices to `normals`, as they become final. */
  PointNormals(Pool& pool, const VertexFile& positions, VertexFile& normals)
    : Points(pool, positions)
    , Sums(pool, 4)
    , Normals(normals)
  {
  }

  /** Adds the next block; `held` is 1 at its vertices that are held. */
  void add(const MeshBlock& block, std::span<const std::uint8_t> held);
  /** To be called after the last block. */
  void finish();

private:
  void addCell(const std::int64_t* corners);
  void write(std::int64_t finalized);

  OpenTuples Points;
  Ring<double> Sums; ///< the sum of weighted normals, and whether the vertex is held
  VertexFile& Normals;
  std::vector<double> Units; ///< normals to be written
};

/**
 * The volume that triangles sweep when their corners move from x to y + c n along straight lines,
 * as a polynomial of the distance c. Positive if they move to the side of their normals; of a
 * closed surface it is the difference of the enclosed volumes.
 */
class SweptVolume
{
public:
  /** Adds a triangle: the x, y, z of each corner before and after the motion, and its n. */
  void add(const double* const* x, const double* const* y, const double* const* n);

  /** The volume at the distance c. */
  double at(double c) const;
  /** A distance of at most `most` with which no volume is swept, by Newton's method from 0; none if
   * that does not find one. */
  std::optional<double> root(double most) const;

private:
  double slope(double c) const;

  std::array<double, 4> Coefficients{}; ///< of 1, c, c^2, c^3
};

} // namespace smg
