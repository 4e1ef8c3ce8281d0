// SPDX-License-Identifier: BSD-3-Clause
#include "smg/WriteMesh.h"

#include "IO/External/Workspace.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/RewritePly.h"
#include "IO/Formats/Streams/RewriteStream.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Results/MovedVertices.h"
#include "smg/Error.h"

namespace smg
{

namespace
{

bool isPlainPly(const std::filesystem::path& path)
{
  return formatOfFile(path) == &PlyFormat && !isGzip(InputFile(path).at(0, 2));
}

} // namespace

bool canRewrite(const std::filesystem::path& in, const std::filesystem::path& out)
{
  const MeshFileKind from = kindOfInput(in);
  const MeshFileKind to = kindOfOutput(out);
  if (from == MeshFileKind::Stream && to == MeshFileKind::Stream)
  {
    return cellTypeOf(detectStreamFormat(in)) == cellTypeOf(*streamFormatOfName(out));
  }
  return from == MeshFileKind::Indexed && formatOfName(out) == &PlyFormat && isPlainPly(in);
}

void rewriteMesh(const std::filesystem::path& in, const std::filesystem::path& out,
  MeshSource& moved, const RewriteOptions& options)
{
  if (!canRewrite(in, out))
  {
    throw Error(out.string() + ": the order of " + in.string() +
                " can be kept in a file of the same kind only, from a streaming format to a "
                "streaming format for these cells, or from PLY to PLY.");
  }
  Workspace workspace(options.scratch, options.memory);
  MovedVertices vertices(moved, workspace, partOf(options.progress, 0.0, 0.3));
  const ProgressFunction progress = partOf(options.progress, 0.3, 1.0);
  if (formatOfName(out) == &PlyFormat)
  {
    rewritePly(in, out, vertices, progress);
  }
  else
  {
    rewriteStream(in, out, vertices, progress);
  }
}

} // namespace smg
