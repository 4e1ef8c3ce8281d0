// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

// Names of the vertex columns, and of the VTK point arrays, that hold handles: see VertexHandles.

inline constexpr const char* HandleMaskName = "HandleMask";         ///< mask: uint8
inline constexpr const char* HandleTargetName = "HandleTarget";     ///< target: 3 x float64
inline constexpr const char* HandleRotationName = "HandleRotation"; ///< rotation: 3 x float64
inline constexpr const char* HandleLogScaleName = "HandleLogScale"; ///< logScale: float64

/** Handles at consecutive vertices. Of a free vertex only `mask` is looked at. */
struct VertexHandles
{
  /** One a vertex: the number of handles that hold it, of which the last one counts. 0: free. */
  std::vector<std::uint8_t> mask;
  /** Three a vertex: its new position x, y, z, in the unit of the mesh. */
  std::vector<double> target;
  /** Three a vertex: its rotation vector, the unit axis times the angle in radians, of any size. */
  std::vector<double> rotation;
  /** One a vertex: the natural logarithm of its scale, from -46 to 46. */
  std::vector<double> logScale;

  /** Makes this `vertices` free vertices. */
  void clear(std::size_t vertices)
  {
    this->mask.assign(vertices, 0);
    this->target.assign(3 * vertices, 0.0);
    this->rotation.assign(3 * vertices, 0.0);
    this->logScale.assign(vertices, 0.0);
  }
};

/** The handles by which a mesh is deformed. They are asked once for each block, in stream order. */
class SMG_EXPORT Handles
{
public:
  virtual ~Handles() = default;

  /**
   * Sets the handles at the vertices of a block.
   * @param block the next block of the stream
   * @param handles the block's vertices, all free on entry. deform() throws Error if its size
   * changes, a number at a held vertex is not finite, or a scale there is outside 1e-20 to 1e20.
   */
  virtual void at(const MeshBlock& block, VertexHandles& handles) = 0;
  /** See Problem::bytes(). */
  virtual std::int64_t bytes() const { return 0; }
};

/**
 * How to deform: the options of a solve, which hold for each of the two steps, and these.
 * `operators` must be "extended".
 */
struct DeformOptions : SolveOptions
{
  /** `tolerance` is 1e-6 by default: positions have no use for more digits. */
  DeformOptions() { this->tolerance = 1e-6; }

  /** Weights of the edges, in both steps. */
  Weights weights = Weights::Clamped;
  /** V-cycles of each step, whatever the residual; 0: as many as `tolerance` takes, `maxCycles`
   * at most. */
  int cycles = 0;
};

/**
 * Deforms a mesh by handles and keeps its details: two Poisson problems on one hierarchy.
 *
 * The rotation step spreads the handles' rotation vectors and logarithms of scale harmonically over
 * the mesh. The position step finds the positions whose edges are closest, in the weighted
 * least-squares sense, to the edges at rest, rotated and scaled: its right-hand side is
 * (div d)_i = sum_j w_ij d_ij, d_ij = (s_i R_i + s_j R_j) / 2 (p_i - p_j), which for scales of 1 is
 * that of Sorkine and Alexa 2007. With k V-cycles a step this takes 2 k + 1 passes over the mesh:
 * the last prolongation of the first step and the first restriction of the second one share a pass.
 *
 * Components of the mesh without a held vertex, and vertices without a weighted cell, stay exactly
 * where they are.
 *
 * @param mesh the mesh stream, read once
 * @param handles the handles, asked once for each block
 * @param options how to solve
 * @return the positions: three columns, x, y, z, in the unit of the mesh. Solution::report() has
 * both steps in Report::steps.
 * @throws Error as solve(), if no vertex is held, or if what `handles` sets is not valid (see
 * Handles::at())
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> deform(
  MeshSource& mesh, Handles& handles, const DeformOptions& options = {});

} // namespace smg
