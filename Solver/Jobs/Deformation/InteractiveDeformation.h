// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

class DeformationEngine;

/**
 * A deformation in memory with fast updates, for dragging handles: hierarchy and factor are kept as
 * long as the same vertices are held. Every result equals that of deform() with the same handles,
 * bit for bit, independent of previous updates.
 */
class SMG_EXPORT InteractiveDeformation : public Solution
{
public:
  /**
   * Builds the hierarchy and deforms once. Throws Error like deform(); options.inCore is implied.
   */
  InteractiveDeformation(MeshSource& mesh, Handles& handles, const DeformOptions& options = {});
  ~InteractiveDeformation() override;

  /**
   * Repeats the deformation. `handles` has the values of all vertices, in stream order.
   * @return false, without any change, if other vertices are held than before
   * @throws Error if a value is not finite (without any change), or if the solve diverges;
   * Cancelled. After the last two, read() throws Error until an update succeeds.
   */
  bool update(const VertexHandles& handles);

  std::int64_t vertices() const override;
  int columns() const override { return 3; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  /** The report of the last deformation: seconds.build is 0 after update(). */
  const Report& report() const override;

private:
  bool holdsTheSame(const VertexHandles& handles) const;
  void take(const VertexHandles& handles);

  std::unique_ptr<DeformationEngine> Engine;
  bool Broken = false; ///< an update ended with an exception
};

} // namespace smg
