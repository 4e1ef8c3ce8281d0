// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamsFormat.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"

namespace smg
{

namespace
{

/** These formats require the last cell of each vertex in advance. */
WriteNotes write(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const WriteMeshOptions& options)
{
  return vsmToStream(vsm, path, options.scratch, options.progress);
}

std::optional<FileCounts> countsOfStream(InputFile& file, const MeshPart&)
{
  const StreamFileHeader header = openStreamFile(file.path())->header();
  if (header.vertices < 0 || header.cells < 0)
  {
    return {};
  }
  const std::int64_t columnBytes = header.vertices * 4 * (header.vertexFloats + header.vertexInts) +
                                   header.cells * 4 * header.cellInts;
  return FileCounts{ header.vertices, header.cells, cornersOf(cellTypeOf(header.format)),
    columnBytes, true };
}

constexpr FileSuffix StreamSuffixes[] = { { ".sma", true, false, true }, { ".smb", true, false },
  { ".sva", false, true, true }, { ".svb", false, true } };

} // namespace

const Format StreamsFormat{
  .name = "mesh stream",
  .suffixes = StreamSuffixes,
  .attributes = "a scalar of the vertices of tetrahedra",
  .kind = MeshFileKind::Stream,
  .counts = countsOfStream,
  .writeVsm = write,
};

} // namespace smg
