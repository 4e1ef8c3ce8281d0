// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyFormat.h"

#include "IO/Files/TextStart.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Formats/Ply/WritePly.h"

#include <algorithm>

namespace smg
{

namespace
{

bool isPly(std::string_view start)
{
  const std::string_view bytes = withoutMark(start);
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

std::optional<FileCounts> countsOfPly(InputFile& file, const MeshPart&)
{
  FileCounts counts;
  counts.counted = true;
  double least = 0;
  for (const PlyElement& element : readPlyHeader(file).elements)
  {
    std::int64_t bytes = 0;
    for (const PlyProperty& property : element.properties)
    {
      bytes += property.list ? 0 : static_cast<std::int64_t>(sizeOf(property.type));
    }
    // Every property takes at least a byte: the length of a list, or the space after a number.
    least += static_cast<double>(element.count) * static_cast<double>(element.properties.size());
    if (least > static_cast<double>(file.size()))
    {
      return {};
    }
    if (element.name == "vertex")
    {
      counts.vertices = element.count;
      counts.columnBytes += element.count * std::max<std::int64_t>(bytes - 12, 0);
    }
    else if (element.name == "face")
    {
      counts.cells = element.count;
      counts.columnBytes += element.count * bytes;
    }
  }
  return counts;
}

WriteNotes write(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  return notesOn(writePly(source, path, options.progress));
}

constexpr FileSuffix PlySuffixes[] = { { ".ply", true, false } };

} // namespace

const Format PlyFormat{
  .name = "PLY",
  .suffixes = PlySuffixes,
  .attributes = AllColumns,
  .hasSign = isPly,
  .parse = parseWith<importPly>,
  .counts = countsOfPly,
  .write = write,
  .restore = writeRestoredPly,
};

} // namespace smg
