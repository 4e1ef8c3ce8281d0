// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Reads the mesh stream once and creates a preview: the surface simplified by edge collapse to at
 * most `maximumPoints` points (MinPreviewPoints to MaxPreviewPoints), in stream order; of
 * tetrahedra, their outer surface. Each point is a vertex of the mesh, with the columns of the
 * stream and a normal: the mean of the triangles around it by their angles. A mesh of fewer points
 * is returned unchanged. No vertex is a ghost.
 *
 * Where the edges of a mesh cannot be collapsed, vertices near one another are merged instead.
 *
 * Memory is bounded by that of StreamSimplifier, which is what the number of points and the width
 * of the stream ask for, but at most `maxMemory` bytes. `notes` gets what is lost, in
 * sentences. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {},
  std::int64_t maxMemory = std::numeric_limits<std::int64_t>::max(),
  std::vector<std::string>* notes = nullptr);

/** The expected cost of a PreviewSource of so many points, and of writing it to the file `out`, as
 * text or not; `conversion` is that of the mesh. Its memory has no limit but what the preview asks
 * for. */
SMG_EXPORT JobEstimate previewEstimate(const EstimatedInput& mesh, std::int64_t maximumPoints,
  const std::filesystem::path& out, bool text, const ConversionOptions& conversion);

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
  SolidPreviewCells cells = SolidPreviewCells::Triangles,
  std::vector<std::string>* notes = nullptr);

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

/** The error message for an empty preview of a mesh that is not empty. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

/** Triangles between some of the vertices of a surface. */
struct CoarserSurface
{
  std::vector<std::int64_t> vertices; ///< their numbers in the surface, ascending
  std::vector<std::int64_t> corners;  ///< places in `vertices`, three a triangle
};

/**
 * Simplifies a surface in memory by edge collapse, as StreamSimplifier does at its end.
 * @param points x, y, z of each vertex
 * @param corners three a triangle
 * @param locked of each vertex: not 0 for one that stays
 * @param most so many vertices are left, besides the locked ones
 */
SMG_EXPORT CoarserSurface coarserSurface(std::span<const double> points,
  std::span<const std::int64_t> corners, std::span<const std::uint8_t> locked, std::int64_t most);

} // namespace smg
