// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/LayoutSource.h"
#include "IO/Preview/PreviewPiece.h"

#include <optional>
#include <string>

namespace smg
{

/** Vertex column of a preview, int64: the stream index of each point in the mesh. (The name
 * GlobalIds is reserved for VTK pieces, where it has the same meaning.) */
inline constexpr const char* StreamIndexName = "StreamIndex";

/**
 * The preview of a mesh (see makePreviewPiece()) as a mesh stream of triangles, compact and in
 * breadth-first order, to be written to a file. It has all vertex columns of the mesh, including
 * OriginalId with the indices in the original file, and the column StreamIndex.
 */
class PreviewSource : public MeshSource
{
public:
  /**
   * Reads the mesh once, and its vertex columns once. Error messages name the mesh `name`, or its
   * file if that is empty. A large preview creates scratch files in `scratch`; empty: the system's
   * temporary folder.
   * @throws Error if the preview is empty because every triangle collapses; Cancelled
   */
  explicit PreviewSource(VsmReader& mesh, std::int64_t maximumPoints = DefaultPreviewPoints,
    const ProgressFunction& progress = {}, const std::string& name = {},
    const std::filesystem::path& scratch = {});
  PreviewSource(const PreviewSource&) = delete;
  PreviewSource& operator=(const PreviewSource&) = delete;

  const StreamInfo& info() const override { return this->Source->info(); }
  bool next(MeshBlock& block) override { return this->Source->next(block); }

private:
  Workspace Space;
  std::optional<RawMesh> Mesh;
  std::optional<StreamLayout> Layout;
  std::optional<LayoutSource> Source;
};

} // namespace smg
