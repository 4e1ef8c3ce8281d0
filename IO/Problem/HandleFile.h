// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deform.h"
#include "Solver/Deformation/HandleMotion.h"
#include "Solver/Description/Selection.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** What a handle file says. */
struct HandleFileData
{
  /** What each handle holds. A vertex that several hold follows the last one. */
  std::vector<Region> regions;
  /** How each of them moves. */
  std::vector<HandleMotion> motions;
  /** How to deform, where the file says it; not both of cycles and tolerance. */
  std::optional<Weights> weights;
  std::optional<int> cycles;
  std::optional<double> tolerance;
};

/**
 * The handles of a file: regions of the mesh that stay or move. Vertices are named by the column
 * OriginalId, or by their stream index if the mesh has no such column.
 */
class HandleFile : public Handles
{
public:
  /** `mesh` is the mesh the handles are for. `file` is what errors call the file. */
  HandleFile(HandleFileData data, const StreamInfo& mesh, std::string file = "handles");

  void at(const MeshBlock& block, VertexHandles& handles) override;

  /** Sets the options that the file says, and leaves the others. */
  void applyTo(DeformOptions& options) const;

  /** The vertex columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->OfMesh.vertexColumns(); }

  /**
   * Reads the stream once and throws Error naming the region if a region selects no vertex, or
   * names a vertex that the mesh does not have.
   * @return what a user should know: handles whose vertices all follow later ones, and that nothing
   * moves
   */
  std::vector<std::string> check(MeshSource& mesh);

private:
  HandleFileData Data;
  MeshColumns OfMesh;
  std::vector<std::unique_ptr<Selection>> Regions; ///< those of the data
};

/**
 * Reads a handle file:
 *
 *     { "handles": [ { "region": { "sphere": [x, y, z, r] }, "fixed": true },
 *                    { "region": { "box": [x0, y0, z0, x1, y1, z1] }, "translate": [x, y, z] },
 *                    { "region": { "halfspace": [nx, ny, nz, d] },
 *                      "rotate": { "axis": [x, y, z], "degrees": a, "center": [x, y, z] },
 *                      "scale": s, "translate": [x, y, z] },
 *                    { "region": { "vertices": [original numbers] },
 *                      "scale": s, "center": [x, y, z] } ],
 *       "weights": "clamped" | "cotangent" | "uniform", "cycles": k }
 *
 * A handle has a region and is either fixed or moves by one or more of `rotate`, `scale` (from
 * 1e-20 to 1e20) and `translate`: rotation and scale about the same centre first, then translation.
 * The axis has any length but 0, the angle is from -1e6 to 1e6 degrees: 200 are not -160. The
 * centre stands in the rotation or in the handle; without one it is the middle of the handle's
 * sphere or box, and an error for other regions.
 *
 * `cycles` (V-cycles of each step, 1 to 1000000) or `tolerance` (between 0 and 1), not both, say
 * when to stop; they and `weights` (see Weights in Solver/Problem/Problem.h) may be left out.
 * @throws Error naming the file and the place in it
 */
HandleFileData readHandleFileData(const std::filesystem::path& path);

/** The same for a mesh. */
std::unique_ptr<HandleFile> readHandleFile(
  const std::filesystem::path& path, const StreamInfo& mesh);

} // namespace smg
