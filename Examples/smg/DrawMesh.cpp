// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"

#include "ProgressBar.h"

#include "IO/Files/PartialProgress.h"
#include "smg/Error.h"

#include <cstdio>

html::ResultSurface drawnBy(
  const std::filesystem::path& written, const std::function<html::ResultSurface()>& draw)
{
  try
  {
    return draw();
  }
  catch (const smg::Cancelled&)
  {
    if (!written.empty())
    {
      std::fprintf(stderr, "smg: %s is written, its report is not\n", written.c_str());
    }
    throw;
  }
  catch (const smg::Error& error)
  {
    html::ResultSurface none;
    none.failure = error.what();
    return none;
  }
}

html::ResultSurface surfaceOf(const smg::VsmReader& mesh, const CommonOptions& common)
{
  return drawnBy({},
    [&]
    {
      ProgressBar bar("drawing", common.quiet);
      return html::resultSurface(
        *mesh.source(), {}, common.memoryBytes(DrawingMemory), bar.function());
    });
}

html::ResultSurface surfaceOf(const std::filesystem::path& written, const CommonOptions& common)
{
  return drawnBy(written,
    [&]
    {
      ProgressBar bar("drawing", common.quiet);
      CommonOptions opening = common;
      opening.checkpoint.clear();
      opening.input = {};
      const auto mesh = opening.openInput(written, smg::partOf(bar.function(), 0.0, 0.5));
      return html::resultSurface(*mesh->reader().source(), {}, common.memoryBytes(DrawingMemory),
        smg::partOf(bar.function(), 0.5, 1.0));
    });
}
