// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/PreviewPiece.h"

#include <optional>

namespace smg
{

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
