// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Mesh/Format.h"

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
  FileCounts counts{ streamInfoOf(header), true };
  counts.mesh.vertices = header.vertices;
  counts.mesh.cells = header.cells;
  return counts;
}

/** The elements of a binary file have as many words as a cell, and a bit. */
std::int64_t bytesOfStream(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  const int corners = cornersOf(mesh.cellType);
  if (written.suffix.form == FileForm::Text)
  {
    constexpr double Keyword = 2.0;
    return textBytes(mesh.vertices, Keyword + positionCharacters(false)) +
           textBytes(mesh.cells, Keyword + corners * numberCharacters(mesh.vertices));
  }
  const std::int64_t elements = mesh.vertices + mesh.cells;
  return elements * corners * 4 + elements / 8;
}

constexpr FileSuffix StreamSuffixes[] = { { ".sma", true, false, FileForm::Text },
  { ".smb", true, false }, { ".sva", false, true, FileForm::Text }, { ".svb", false, true } };

} // namespace

const Format StreamsFormat{
  .name = "mesh stream",
  .suffixes = StreamSuffixes,
  .description = "SMA and SVA are text, SMB and SVB binary",
  .cells = "triangles (SMA, SMB), tetrahedra (SVA, SVB)",
  .kind = MeshFileKind::Stream,
  .counts = countsOfStream,
  .bytes = bytesOfStream,
  .writeVsm = write,
};

} // namespace smg
