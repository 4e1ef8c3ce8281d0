// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/Handles.h"
#include "smg/Solution.h"

#include <memory>

namespace smg
{

/**
 * A deformation in memory that can be repeated fast, for dragging handles: hierarchy and factor are
 * kept as long as the same vertices are held. Every result is, bit for bit, that of deform() with
 * the same handles: it does not depend on what came before.
 */
class SMG_EXPORT InteractiveDeformation : public Solution
{
public:
  /** Builds the hierarchy and deforms once. Throws Error as deform(); options.inCore is implied. */
  InteractiveDeformation(MeshSource& mesh, Handles& handles, const DeformOptions& options = {});
  ~InteractiveDeformation() override;

  /**
   * Deforms again. `handles` are those of all vertices, in stream order.
   * @return false, and nothing is changed, if other vertices are held than before
   * @throws Error if something is not finite (then, too, nothing is changed), or the solve
   * diverges; Cancelled. After these two, read() throws Error until an update succeeds.
   */
  bool update(const VertexHandles& handles);

  std::int64_t vertices() const override;
  int columns() const override { return 3; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  /** Of the last deformation: seconds.build is 0 after update(). */
  const Report& report() const override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
