// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Names of the vertex columns, and of the VTK point arrays, that store handles. */
inline constexpr const char* HandleMaskName = "HandleMask";         ///< uint8
inline constexpr const char* HandleTargetName = "HandleTarget";     ///< 3 double
inline constexpr const char* HandleRotationName = "HandleRotation"; ///< 3 double
inline constexpr const char* HandleLogScaleName = "HandleLogScale"; ///< double

/** The handles at a range of vertices: one entry, or three numbers, per vertex. */
struct VertexHandles
{
  /** The number of handles that hold the vertex; the last one counts. 0: the vertex is free. */
  std::vector<std::uint8_t> mask;
  /** The target (x, y, z) of a held vertex. Not used at free vertices. */
  std::vector<double> target;
  /** The rotation of a held vertex: the unit axis times the unbounded angle in radians. */
  std::vector<double> rotation;
  /** The natural logarithm of the scale of a held vertex. */
  std::vector<double> logScale;

  /** Resets to `vertices` free vertices. */
  void clear(std::size_t vertices)
  {
    this->mask.assign(vertices, 0);
    this->target.assign(3 * vertices, 0.0);
    this->rotation.assign(3 * vertices, 0.0);
    this->logScale.assign(vertices, 0.0);
  }
};

/** The handles of a deformation. They are queried once, block by block, in stream order. */
class SMG_EXPORT Handles
{
public:
  virtual ~Handles() = default;

  /** Sets the handles at the vertices of the block; on entry, `handles` has only free vertices.
   * Values at held vertices must be finite. */
  virtual void at(const MeshBlock& block, VertexHandles& handles) = 0;
};

} // namespace smg
