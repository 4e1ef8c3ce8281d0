// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Names of the vertex columns, and of the VTK point arrays, that hold handles. */
inline constexpr const char* HandleMaskName = "HandleMask";         ///< uint8
inline constexpr const char* HandleTargetName = "HandleTarget";     ///< 3 double
inline constexpr const char* HandleRotationName = "HandleRotation"; ///< 3 double
inline constexpr const char* HandleLogScaleName = "HandleLogScale"; ///< double

/** What the handles say at a stretch of vertices: one entry, or three numbers, a vertex. */
struct VertexHandles
{
  /** How many handles hold the vertex; the last one counts. 0: the vertex is free. */
  std::vector<std::uint8_t> mask;
  /** Where a held vertex goes: x, y, z. Not looked at where the vertex is free. */
  std::vector<double> target;
  /** How a held vertex turns: the unit axis times the angle in radians, of any size. */
  std::vector<double> rotation;
  /** How a held vertex grows: the natural logarithm of the scale. */
  std::vector<double> logScale;

  /** `vertices` free vertices. */
  void clear(std::size_t vertices)
  {
    this->mask.assign(vertices, 0);
    this->target.assign(3 * vertices, 0.0);
    this->rotation.assign(3 * vertices, 0.0);
    this->logScale.assign(vertices, 0.0);
  }
};

/** The handles by which a mesh is deformed. They are asked block by block, in stream order, once.
 */
class SMG_EXPORT Handles
{
public:
  virtual ~Handles() = default;

  /**
   * Says what holds at the vertices of the block; `handles` is clear. What is not finite at a held
   * vertex is an error.
   */
  virtual void at(const MeshBlock& block, VertexHandles& handles) = 0;
};

} // namespace smg
