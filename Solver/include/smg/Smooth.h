// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"
#include "smg/Solve.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** The size of the details that smoothing halves. */
struct SmoothingSize
{
  /** What `value` is a multiple of. */
  enum Unit
  {
    MeanEdges, ///< the mean length of the edges of the mesh
    Mesh,      ///< 1: the value is in the unit of the mesh
    Diagonal   ///< the diagonal of the bounds of the mesh
  };

  double value = 4;      ///< more than 0
  Unit unit = MeanEdges; ///< what it is a multiple of
};

/** What becomes of the boundary of a surface that is smoothed. */
enum class SmoothedBoundary
{
  /** It is smoothed as curves, regardless of the surface, by the same size. Positions only. */
  Smooth,
  Fixed, ///< it does not move
  Free   ///< it moves with the surface: (grad u) . n = 0
};

/** What to smooth, and how far. */
struct SmoothingDescription
{
  /** Waves of this length are halved by all steps together. Waves of a third of it are reduced to a
   * tenth by one step, and to less by more steps. */
  SmoothingSize size;
  /** Implicit steps, 1 to 1000. More steps follow the surface as it becomes smoother: the measure
   * of each is that of the surface after the one before. */
  int steps = 1;
  /** Parts of the mesh that keep their values, by their vertices; may be empty. */
  std::vector<Where> hold;
  /** None: Smooth for positions, Free for a column. */
  std::optional<SmoothedBoundary> boundary;
  /** Whether each step of positions moves all vertices along their normals, by the distance with
   * which the surface sweeps no volume: that of a closed surface is kept. */
  bool keepVolume = true;
  /** Keeps edges at which the surface turns by more than this angle, in degrees, above 0 and below
   * 180: about 30 for machined parts. Needs about 5 steps. None: all edges become round. */
  std::optional<double> keepEdges;
  /** Whether the triangles of the result are turned where those of a body are not wound alike, and
   * all of a closed body that is wound inwards, with those that lie in it; one that is wound
   * against what it lies in is a cavity, and stays one: MovedMesh has them. Of positions only. */
  bool orient = false;
  /** The vertex column to smooth, of any numeric type and at most 64 components; empty: the
   * positions. */
  std::string column;
};

/**
 * Smooths the positions of a surface, or a column of the vertices of any mesh, by implicit fairing
 * (Desbrun, Meyer, Schroeder and Barr 1999). Step k solves (M_k + t L) x_{k+1} = M_k x_k: L is the
 * cotangent stiffness of the mesh as it is given, M_k the lumped mass of the mesh of step k
 * (Kazhdan, Solomon and Ben-Chen 2012; of a column M_0), and t = (2^(1/N) - 1) (S / 2 pi)^2 for N
 * steps and the size S. With `keepEdges`, the stiffness is that of a conductivity that is small
 * across edges (Clarenz, Diewald and Rumpf 2000), on the surface smoothed by one step of size S.
 *
 * The mesh is read once before the first step, and by each step as often as by solve(), once to
 * three times more to keep volume or edges. A smoothed boundary is held in memory.
 *
 * @param mesh the mesh
 * @param description what to smooth, and how far
 * @param options how to solve, in each step; `operators` must be "extended"
 * @return the smoothed positions (x, y, z) or the smoothed column, in stream order. Its report has
 * the steps in Report::steps, and Report::volume for positions.
 * @throws Error as solve(); if an option is out of range, a part in `hold` is not valid or holds no
 * vertex, the mesh has no such column, a value of it is not finite, or positions of tetrahedra are
 * to be smoothed
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> smooth(const StoredMesh& mesh,
  const SmoothingDescription& description = {}, const SolveOptions& options = {});

} // namespace smg
