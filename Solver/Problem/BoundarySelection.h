// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/Selection.h"

#include <optional>

namespace smg
{

/** The vertices of the boundary, found by a reading of the stream beforehand: a vertex precedes the
 * cells that could close the facets around it. Cells and facets are selected by their corners. For
 * cells, too, it is only an error if no vertex is on the boundary. */
class BoundarySelection : public Selection
{
public:
  BoundarySelection(DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
  {
  }

  bool needsPreparing() const override { return !this->Vertices || this->Open; }
  void endPreparing(MeshParts* parts) override;
  VertexSetFile* preparedVertices() override { return this->Vertices ? &*this->Vertices : nullptr; }
  /** Like endPreparing(), but a mesh without a boundary is not an error. Returns the number of
   * vertices on the boundary. */
  std::int64_t finish(MeshParts* parts = nullptr);

protected:
  void begin() override;
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override { return "is on a boundary: the mesh is closed"; }

private:
  /** The open vertices during preparation. */
  struct Window
  {
    explicit Window(const MeshColumns& columns)
      : facets(columns.memory(), columns.cellType())
      , marks(columns.memory())
    {
    }

    BoundaryFacets facets;
    FacetSet inner;                 ///< interior facets with only one cell in the stream
    OpenValues<std::uint8_t> marks; ///< 1: on the boundary
    std::int64_t vertices = 0, written = 0;
  };

  /** Marks the vertices of boundary facets. */
  auto marker();
  void write(std::int64_t finalized);

  std::optional<Window> Open;
  std::optional<VertexSetFile> Vertices;
};

} // namespace smg
