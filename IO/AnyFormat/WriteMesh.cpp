// SPDX-License-Identifier: BSD-3-Clause
#include "IO/AnyFormat/WriteMesh.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/Files/Suffix.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Vsm/VsmReader.h"

namespace smg
{

std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  checkOutput(path, source.info().cellType);
  return formatOfSuffix(lowerSuffix(path))->write(source, path, options);
}

std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress)
{
  if (kindOfOutput(path) != MeshFileKind::Stream)
  {
    WriteMeshOptions options;
    options.isolatedFrom = vsm;
    options.progress = progress;
    return writeMesh(*VsmReader(vsm).source(), path, options);
  }
  return notesOnRounded(vsmToStream(vsm, path, progress));
}

} // namespace smg
