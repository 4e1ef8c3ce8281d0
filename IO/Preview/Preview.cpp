// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Preview.h"

#include "IO/Files/PartialProgress.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Order/Assembly/LayoutSource.h"
#include "IO/Order/LayOut.h"
#include "IO/Preview/StreamPreview.h"
#include "smg/Error.h"

#include <optional>
#include <span>
#include <string>

namespace smg
{

namespace
{

/** Memory for sorting a preview: sufficient for ten million points. */
constexpr std::int64_t OrderMemory = std::int64_t(256) << 20;

const ColumnSpec StreamIndexSpec{ StreamIndexName, ScalarType::Int64, 1 };

/** The preview as a raw mesh of triangles. */
RawMesh rawMesh(const MeshPiece& piece, bool doublePositions, Workspace& workspace)
{
  RawMeshBuilder builder(workspace, CellChoice::Only);
  if (!doublePositions)
  {
    builder.useSinglePrecision();
  }
  for (std::size_t i = 0; i < piece.positions.size(); i += 3)
  {
    builder.vertex(piece.positions[i], piece.positions[i + 1], piece.positions[i + 2]);
  }
  const auto ids = std::as_bytes(std::span(piece.ids));
  bool original = false;
  for (const Column& column : piece.vertexColumns)
  {
    // The mesh may itself be a preview, whose StreamIndex refers to another mesh.
    if (column.spec.name != StreamIndexName)
    {
      ImportColumn(builder, ColumnOf::Vertices, column.spec).append(column.bytes);
      original = original || column.spec == OriginalIdSpec;
    }
  }
  ImportColumn(builder, ColumnOf::Vertices, StreamIndexSpec).append(ids);
  if (!original)
  {
    ImportColumn(builder, ColumnOf::Vertices, OriginalIdSpec).append(ids);
  }
  for (std::size_t i = 0; i < piece.corners.size(); i += 3)
  {
    builder.triangle(piece.corners[i], piece.corners[i + 1], piece.corners[i + 2]);
  }
  return builder.finish();
}

} // namespace

struct PreviewSource::Implementation
{
  Workspace space;
  std::vector<std::string> notes;
  std::optional<RawMesh> mesh;
  std::optional<StreamLayout> layout;
  std::optional<LayoutSource> source;
};

PreviewSource::PreviewSource(VsmReader& mesh, std::int64_t maximumPoints,
  const ProgressFunction& progress, const std::string& name, const std::filesystem::path& scratch)
  : Self(
      new Implementation{ { scratch, OrderMemory, partOf(progress, 0.95, 1.0) }, {}, {}, {}, {} })
{
  if (maximumPoints < MinPreviewPoints || maximumPoints > MaxPreviewPoints)
  {
    throw Error("the limit of a preview is " + std::to_string(maximumPoints) +
                " points; expected " + std::to_string(MinPreviewPoints) + " to " +
                std::to_string(MaxPreviewPoints) + ".");
  }
  const MeshPiece piece = makePreviewPiece(mesh, maximumPoints, partOf(progress, 0.0, 0.95),
    SolidPreviewCells::Triangles, &this->Self->notes);
  if (piece.corners.empty())
  {
    throw Error((name.empty() ? mesh.path().string() : name) + ": " + emptyPreview(maximumPoints));
  }
  Implementation& self = *this->Self;
  self.mesh.emplace(rawMesh(piece, mesh.info().doublePositions, self.space));
  LayOutCounts counts;
  self.layout.emplace(layOut(*self.mesh, StreamOrder::BreadthFirst, self.space, counts));
  self.source.emplace(*self.mesh, *self.layout, self.space, LayoutSource::WithoutCellIds);
}

PreviewSource::~PreviewSource() = default;

const StreamInfo& PreviewSource::info() const
{
  return this->Self->source->info();
}

const std::vector<std::string>& PreviewSource::notes() const
{
  return this->Self->notes;
}

bool PreviewSource::next(MeshBlock& block)
{
  return this->Self->source->next(block);
}

} // namespace smg
