// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace smg
{

/** Number of points of a preview where nothing else is asked for. */
inline constexpr std::int64_t DefaultPreviewPoints = 10000;
/** What can be asked for. */
inline constexpr std::int64_t LeastPreviewPoints = 8;
inline constexpr std::int64_t MostPreviewPoints = 1000000;

/**
 * Vertex column of a preview, int64: which vertex of the mesh a point is, by its stream index. (The
 * name GlobalIds belongs to VTK's pieces, where it means the same.)
 */
inline constexpr const char* StreamIndexName = "StreamIndex";

/**
 * The preview of a mesh as a mesh stream of triangles, compact and in
 * breadth-first order, to be written as a file. It has all vertex columns of the mesh, of which
 * OriginalId names the mesh's vertices in their file, and the column StreamIndex.
 */
class SMG_EXPORT PreviewSource : public MeshSource
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
  ~PreviewSource() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
