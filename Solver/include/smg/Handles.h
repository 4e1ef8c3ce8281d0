// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
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
};

} // namespace smg
