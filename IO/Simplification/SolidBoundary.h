// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>

namespace smg
{

/** Finds the outer surface of a stream of tetrahedra: the faces that exactly one tetrahedron has. A
 * face is in memory as long as all of its vertices may still be used, so memory is bounded by the
 * window of the stream. */
class OpenFaces
{
public:
  using Face = std::array<std::int64_t, 3>;

  /** Adds the four faces of a tetrahedron, by the stream indices of its corners. */
  void add(std::span<const std::int64_t, 4> corners);

  /** Passes each open face with a vertex below `finalized`, oriented outwards, to `outer`, and
   * releases it. */
  void closeBelow(std::int64_t finalized, const std::function<void(const Face&)>& outer);

  std::size_t size() const { return this->Open.size(); }

private:
  struct Hash
  {
    std::size_t operator()(const Face& face) const;
  };
  /** The corners in outward order, by the sorted corners. */
  std::unordered_map<Face, Face, Hash> Open;
};

/**
 * The outer surface of a stream of tetrahedra as a stream of triangles, oriented outwards, with all
 * vertices of the solid; a stream of triangles as it is. Duplicate cells are left out.
 */
class SolidBoundary : public MeshSource
{
public:
  /** `mesh` must outlive this. */
  explicit SolidBoundary(MeshSource& mesh);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

private:
  void replaceCells(MeshBlock& block);
  void close(std::int64_t final, MeshBlock& block);

  MeshSource& Mesh;
  StreamInfo Info;
  OpenFaces Faces;
  std::size_t FacesKept = 0;
  std::int64_t Final = 0, Vertices = 0;
  std::int64_t ClosedAt = 0; ///< the number of vertices when faces were closed
  bool IsAtEnd = false;
};

} // namespace smg
