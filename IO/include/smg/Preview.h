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
#include <vector>

namespace smg
{

/** Default limit of the number of points of a preview. */
inline constexpr std::int64_t DefaultPreviewPoints = 100000;
/** The smallest limit that may be given. */
inline constexpr std::int64_t MinPreviewPoints = 8;
/** The largest limit that may be given. */
inline constexpr std::int64_t MaxPreviewPoints = 1000000;

/**
 * Vertex column of a preview (int64): the stream index that each point has in the mesh. (The name
 * GlobalIds, which means the same, belongs to pieces in VTK.)
 */
inline constexpr const char* StreamIndexName = "StreamIndex";

/**
 * A preview of a mesh as a stream of triangles, in breadth-first order: a simplified surface, of a
 * tetrahedral mesh its outer surface (see simplify()). Its points are vertices of the mesh, with
 * all vertex columns, the column StreamIndex, and OriginalId, which is StreamIndex again if the
 * mesh does not have it. It has no attributes of cells.
 */
class SMG_EXPORT PreviewSource : public MeshSource
{
public:
  /**
   * Makes the preview: reads the mesh once, and its vertex columns once.
   * @param mesh the mesh
   * @param maximumPoints limit of the number of points, MinPreviewPoints to MaxPreviewPoints. A
   * surface of fewer points is taken as it is.
   * @param progress progress callback; empty: none
   * @param name what error messages call the mesh; empty: its file name
   * @param scratch folder for scratch files, which only large previews need; empty: the system's
   * temporary folder
   * @throws Error if the limit is out of range, the mesh cannot be read, or all cells repeat a
   * corner or another cell
   * @throws Cancelled if the progress callback returns false
   */
  explicit PreviewSource(VsmReader& mesh, std::int64_t maximumPoints = DefaultPreviewPoints,
    const ProgressFunction& progress = {}, const std::string& name = {},
    const std::filesystem::path& scratch = {});
  ~PreviewSource() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;
  /** What the preview does not show, in sentences. */
  const std::vector<std::string>& notes() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
