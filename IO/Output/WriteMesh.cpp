// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Output/WriteMesh.h"

#include "IO/Container/VsmReader.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/Formats/StreamConversion.h"
#include "IO/Output/WritePly.h"
#include "IO/Output/WriteVsm.h"
#include "IO/Output/WriteVtkXml.h"
#include "Solver/Storage/ScratchFolder.h"

namespace smg
{

namespace
{

/** These formats need the last cell of each vertex first: through a .vsm file. */
std::vector<std::string> writeAsStream(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  const ScratchFolder scratch(options.scratch);
  const std::filesystem::path whole = scratch / "mesh.vsm";
  writeVsm(source, whole, Codec::Lz4, partOf(options.progress, 0.0, 0.6));
  return writeFromVsm(whole, path, partOf(options.progress, 0.6, 1.0));
}

} // namespace

std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  checkOutput(path, source.info().cellType);
  switch (kindOfOutput(path))
  {
    case MeshFileKind::Ply:
      return notesOn(writePly(source, path, options.progress));
    case MeshFileKind::Stream:
      return writeAsStream(source, path, options);
    case MeshFileKind::VtkXml:
      writeVtkXml(source, path, options.progress);
      return {};
    default:
      writeVsm(source, path, options.codec, options.progress, {},
        [&](VsmWriter& writer)
        {
          if (!options.isolatedFrom.empty())
          {
            copyIsolated(options.isolatedFrom, source.info(), writer);
          }
        });
      return {};
  }
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
  const std::int64_t rounded = vsmToStream(vsm, path, progress);
  if (rounded == 0)
  {
    return {};
  }
  return { "The positions of " + std::to_string(rounded) +
           " vertices were rounded to single precision, which is all that the format has." };
}

} // namespace smg
