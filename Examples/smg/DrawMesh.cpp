// SPDX-License-Identifier: BSD-3-Clause
#include "DrawMesh.h"

#include "smg/Error.h"

html::ResultSurface drawnBy(const std::function<html::ResultSurface()>& draw)
{
  try
  {
    return draw();
  }
  catch (const smg::Cancelled&)
  {
    throw;
  }
  catch (const smg::Error& error)
  {
    html::ResultSurface none;
    none.failure = error.what();
    return none;
  }
}

html::ResultSurface surfaceOf(const smg::VsmReader& mesh, std::int64_t memory)
{
  return drawnBy([&] { return html::resultSurface(*mesh.source(), {}, memory, {}); });
}

html::ResultSurface surfaceOf(const std::filesystem::path& written, const CommonOptions& common)
{
  return drawnBy(
    [&]
    {
      CommonOptions opening = common;
      opening.checkpoint.clear();
      opening.input = {};
      const auto mesh = opening.openInput(written, {});
      return html::resultSurface(
        *mesh->reader().source(), {}, common.memoryBytes(DrawingMemory), {});
    });
}
