// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/NearestSelection.h"
#include "Solver/Problem/Selection.h"
#include "Solver/Problem/ValueOnMesh.h"
#include "smg/Deform.h"
#include "smg/DeformationDescription.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** The implementation of DescribedHandles: the handles of a description, resolved on a mesh. */
class HandlesOnMesh : public Handles
{
public:
  /** Like DescribedHandles. */
  HandlesOnMesh(
    const DeformationDescription& description, const StreamInfo& mesh, const std::string& name);
  HandlesOnMesh(const HandlesOnMesh&) = delete;
  HandlesOnMesh& operator=(const HandlesOnMesh&) = delete;

  /** The columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const { return this->OfMesh.vertexColumns(); }
  std::vector<std::string> cellColumns() const { return this->OfMesh.cellColumns(); }

  /** Like DescribedHandles::prepare(). */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit);
  void preparePart(
    MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit);
  /** Null: the stream was the whole mesh. */
  void endPreparing(MeshParts* parts);

  /** Throws Error, which names the column and the vertex, if a number is not finite. */
  void at(const MeshBlock& block, VertexHandles& handles) override;
  std::int64_t bytes() const override { return this->OfMesh.memory().used(); }

  /** Notes for the user, after all blocks have been queried: handles whose vertices all follow
   * later ones, and a deformation without motion. Null: the blocks were the whole mesh. */
  std::vector<std::string> notes(MeshParts* parts) const;

private:
  /** The values of a handle at each vertex. */
  struct Values
  {
    ValueOnMesh target, rotation, logScale;
    std::vector<std::array<double, 3>> targets; ///< one for each nearest vertex, or none
  };
  struct Handle
  {
    std::unique_ptr<Selection> where;          ///< null: everywhere
    const NearestSelection* nearest = nullptr; ///< the same, of targets
    std::optional<NamedColumn> mask;           ///< which selects and counts
    HandleMotion motion;                       ///< if there are no values
    std::optional<Values> values;
    std::string key;
    std::int64_t following = 0; ///< vertices so far not held by a later handle
    bool moves = false;         ///< whether one that follows it is moved, rotated or scaled, so far
  };

  Handle compile(const HandleDescription& handle, const std::string& key);
  /** Adds the targets of nearest vertices. */
  void compileTargets(const HandleDescription& description,
    const std::vector<std::array<double, 3>>& targets, Handle& handle);
  /** Starts a block; returns whether the handle holds each of its vertices. */
  std::span<const std::uint8_t> startBlock(Handle& handle, const MeshBlock& block);
  /** Sets the values of the handle at the `held` vertices of the block. */
  void hold(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;
  void setMotion(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;
  void setValues(const Handle& handle, const MeshBlock& block, std::span<const std::uint8_t> held,
    VertexHandles& to) const;

  MeshColumns OfMesh;
  std::vector<Handle> All;
  std::vector<std::uint8_t> Everywhere; ///< 1 at each vertex of a block
  std::vector<Handle*> Followed;        ///< the handle of each vertex of a block; null: free
};

} // namespace smg
