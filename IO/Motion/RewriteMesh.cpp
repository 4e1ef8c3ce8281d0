// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Motion/RewriteMesh.h"

#include "IO/Conversion/MeshFile.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Import/Importer.h"
#include "IO/Import/Inflate.h"
#include "IO/Import/InputFile.h"
#include "IO/Motion/MovedVertices.h"
#include "IO/Motion/RewritePly.h"
#include "IO/Motion/RewriteStream.h"
#include "Solver/Core/Error.h"

namespace smg
{

namespace
{

bool isPlainPly(const std::filesystem::path& path)
{
  return meshFormat(path) == MeshFormat::Ply && !isGzip(InputFile(path).at(0, 2));
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
  return from == MeshFileKind::Indexed && to == MeshFileKind::Ply && isPlainPly(in);
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
  MovedVertices vertices(
    moved, options.scratch, options.memory, partOf(options.progress, 0.0, 0.3));
  const ProgressFunction progress = partOf(options.progress, 0.3, 1.0);
  if (kindOfOutput(out) == MeshFileKind::Ply)
  {
    rewritePly(in, out, vertices, progress);
  }
  else
  {
    rewriteStream(in, out, vertices, progress);
  }
}

} // namespace smg
