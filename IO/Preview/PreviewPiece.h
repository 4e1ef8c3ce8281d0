// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Preview.h"
#include "smg/VsmReader.h"

#include <optional>

namespace smg
{

/** What a preview of tetrahedra consists of. */
enum class SolidPreviewCells
{
  Triangles, ///< of the outer surface: see makePreview()
  Tetrahedra ///< see makeSolidPreview()
};

/**
 * Creates the preview of a mesh with all its vertex columns. Takes one pass over the mesh, or two
 * for tetrahedra of a solid, and one over its vertex columns. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreviewPiece(VsmReader& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {},
  SolidPreviewCells cells = SolidPreviewCells::Triangles);

/** The last preview of a mesh, which is asked for again and again while a mesh is displayed. */
class KeptPreview
{
public:
  /** The preview, made if the last one had other properties; see makePreviewPiece(). */
  const MeshPiece& of(
    VsmReader& mesh, int points, SolidPreviewCells cells, const ProgressFunction& progress)
  {
    if (!this->Piece || this->Points != points || this->Cells != cells)
    {
      this->Piece.reset();
      this->Piece = makePreviewPiece(mesh, points, progress, cells);
      this->Points = points;
      this->Cells = cells;
    }
    return *this->Piece;
  }

  void clear() { this->Piece.reset(); }

private:
  std::optional<MeshPiece> Piece;
  int Points = 0;
  SolidPreviewCells Cells = SolidPreviewCells::Triangles;
};

} // namespace smg
