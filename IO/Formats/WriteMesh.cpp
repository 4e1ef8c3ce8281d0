// SPDX-License-Identifier: BSD-3-Clause
#include "smg/WriteMesh.h"

#include "IO/External/Workers.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Files/Suffix.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/VsmReader.h"

namespace smg
{

std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  checkOutput(path, source.info().cellType);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  if (format.write)
  {
    return format.write(source, path, options);
  }
  const ScratchFolder scratch(options.scratch);
  const std::filesystem::path whole = scratch / "mesh.vsm";
  Workers workers(options.threads);
  writeVsm(source, whole,
    { .codec = Codec::Lz4,
      .scratch = scratch.path(),
      .workers = &workers,
      .apart = true,
      .progress = partOf(options.progress, 0.0, 0.6) });
  WriteMeshOptions rest = options;
  rest.scratch = scratch.path();
  rest.progress = partOf(options.progress, 0.6, 1.0);
  return format.writeVsm(whole, path, rest);
}

std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress,
  const std::filesystem::path& scratch)
{
  VsmReader reader(vsm);
  checkOutput(path, reader.info().cellType);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  WriteMeshOptions options;
  options.scratch = scratch;
  options.isolatedFrom = vsm;
  options.progress = progress;
  if (format.writeVsm)
  {
    return format.writeVsm(vsm, path, options);
  }
  return writeMesh(*reader.source(), path, options);
}

} // namespace smg
