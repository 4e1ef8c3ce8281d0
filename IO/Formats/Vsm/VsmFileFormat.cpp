// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmFileFormat.h"

#include "IO/Formats/Vsm/WriteVsm.h"
#include "Solver/Storage/Workers.h"

namespace smg
{

namespace
{

WriteNotes write(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  Workers workers(options.threads);
  writeVsm(
    source, path, options.codec, options.progress, {},
    [&](VsmWriter& writer)
    {
      if (!options.isolatedFrom.empty())
      {
        copyIsolated(options.isolatedFrom, source.info(), writer);
      }
    },
    &workers, true);
  return {};
}

constexpr FileSuffix VsmSuffixes[] = { { ".vsm" } };

} // namespace

const Format VsmFileFormat{
  .name = "VSM",
  .suffixes = VsmSuffixes,
  .attributes = AllColumns,
  .kind = MeshFileKind::Vsm,
  .write = write,
};

} // namespace smg
