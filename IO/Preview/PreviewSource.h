// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/LayoutSource.h"
#include "IO/Preview/PreviewPiece.h"

#include <optional>
#include <string>

namespace smg
{

/**
 * Vertex column of a preview, int64: which vertex of the mesh a point is, by its stream index. (The
 * name GlobalIds belongs to VTK's pieces, where it means the same.)
 */
inline constexpr const char* StreamIndexName = "StreamIndex";

/**
 * The preview of a mesh (see makePreviewPiece()) as a mesh stream of triangles, compact and in
 * breadth-first order, to be written as a file. It has all vertex columns of the mesh, of which
 * OriginalId names the mesh's vertices in their file, and the column StreamIndex.
 */
class PreviewSource : public MeshSource
{
public:
  /**
   * Reads the mesh once, and its vertex columns once. Errors call the mesh `name`, or by its file
   * if that is empty. Scratch files, if the preview is so large that it needs any, go to `scratch`;
   * empty: the system's temporary folder.
   * @throws Error if the preview is empty, since every triangle has its corners in one place;
   * Cancelled
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
