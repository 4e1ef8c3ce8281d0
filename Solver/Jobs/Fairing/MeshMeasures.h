// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/Components.h"
#include "Solver/Assembly/OpenComponents.h"
#include "Solver/Memory/Reservation.h"
#include "Solver/Memory/Ring.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace smg
{

/** The diagonal, the mean edge and the volumes of the bodies of a mesh, from one reading of its
 * stream. Cells that are flagged or use a vertex twice are left out. */
class MeshMeasures
{
public:
  MeshMeasures(Pool& pool, CellType type)
    : Type(type)
    , Points(pool, 3)
    , Bodies(0, &pool)
    , Closed(this->Bodies)
    , Parts(pool, this->Bodies, this->Closed)
    , OfVolumes(pool)
  {
  }

  /** Adds the next block. */
  void add(const MeshBlock& block);

  /** The diagonal of the bounds of the vertices; 0 without vertices. */
  double diagonal() const;
  /** The mean length of the edges of the cells, each counted for each of its cells; 0 without
   * cells. */
  double meanEdge() const;
  /** The volume that triangles enclose if they are closed and their normals point outwards. */
  double volume() const;
  /** The sum of the volumes of the bodies that are wound inside out, or are cavities of others. */
  double turnedVolume() const;

private:
  void addCell(const std::int64_t* corners);
  /** Those of the bodies. */
  std::vector<double> bodyVolumes() const;

  CellType Type;
  Ring<double> Points;
  Components Bodies;
  ComponentLabels Closed;
  OpenComponents Parts;
  std::vector<double> Volumes; ///< six times those of the triangles of each label
  Reservation OfVolumes;
  std::array<double, 3> Low{ Infinity, Infinity, Infinity };
  std::array<double, 3> High{ -Infinity, -Infinity, -Infinity };
  std::array<double, 3> Origin{}; ///< of volumes: the first vertex
  double Lengths = 0.0;
  std::int64_t Edges = 0;
  std::int64_t Finalized = 0; ///< after the previous block

  static constexpr double Infinity = std::numeric_limits<double>::infinity();
};

} // namespace smg
