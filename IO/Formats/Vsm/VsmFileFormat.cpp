// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmFileFormat.h"

#include "IO/External/Workers.h"
#include "IO/Formats/Vsm/WriteVsm.h"

namespace smg
{

namespace
{

WriteNotes write(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  Workers workers(options.threads);
  const auto addIsolated = [&](VsmWriter& writer)
  {
    if (!options.isolatedFrom.empty())
    {
      copyIsolated(options.isolatedFrom, source.info(), writer);
    }
  };
  writeVsm(source, path,
    { .codec = options.codec,
      .scratch = options.scratch,
      .add = addIsolated,
      .workers = &workers,
      .apart = true,
      .progress = options.progress });
  return {};
}

constexpr FileSuffix VsmSuffixes[] = { { ".vsm" } };

} // namespace

const Format VsmFileFormat{
  .name = "VSM",
  .suffixes = VsmSuffixes,
  .attributes = AllColumns,
  .kind = MeshFileKind::Vsm,
  .bytes = [](const MeshToWrite& written) { return written.vsmBytes; },
  .write = write,
};

} // namespace smg
