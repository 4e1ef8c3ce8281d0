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

/** The default number of points of a preview. */
inline constexpr std::int64_t DefaultPreviewPoints = 10000;
/** The range of the number of points. */
inline constexpr std::int64_t LeastPreviewPoints = 8;
inline constexpr std::int64_t MostPreviewPoints = 1000000;

/** Vertex column of a preview, int64: the stream index of each point in the mesh. (The name
 * GlobalIds is reserved for VTK pieces, where it has the same meaning.) */
inline constexpr const char* StreamIndexName = "StreamIndex";

/**
 * The preview of a mesh as a mesh stream of triangles, compact and in breadth-first order, to be
 * written to a file. It has all vertex columns of the mesh, including OriginalId with the indices
 * in the original file, and the column StreamIndex.
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
