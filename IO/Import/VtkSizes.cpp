// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/VtkSizes.h"

#include "IO/Import/InputFile.h"
#include "IO/Import/LegacyVtkCells.h"
#include "IO/Import/TextScanner.h"
#include "IO/Import/VtkXmlArrays.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** A well compressed file holds no more than so many bytes of data a byte. */
constexpr std::uint64_t LargestCompression = 1000;

/** The integer that follows `text`, after blanks or quotes; -1 if there is none. */
std::int64_t numberAfter(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(" \t=\"'");
  if (begin == std::string_view::npos)
  {
    return -1;
  }
  std::int64_t value = -1;
  std::from_chars(text.data() + begin, text.data() + text.size(), value);
  return value;
}

/** Sums the counts that follow each `keyword`, and refuses those that cannot be. */
std::int64_t sumOfCounts(
  const InputFile& file, std::string_view text, std::string_view keyword, std::uint64_t most)
{
  std::int64_t sum = 0;
  for (std::size_t at = text.find(keyword); at != std::string_view::npos;
       at = text.find(keyword, at + 1))
  {
    const std::int64_t count = numberAfter(text.substr(at + keyword.size(), 32));
    if (count < 0 || static_cast<std::uint64_t>(count) > most)
    {
      file.fail(
        at, "the number after " + inQuotes(keyword.substr(keyword.find_first_not_of("\n "))) +
              " is missing, negative, or more than the file can hold: it is truncated or wrong");
    }
    sum += count;
  }
  return sum;
}

VtkSizes legacySizes(const InputFile& file)
{
  VtkSizes sizes;
  const std::string_view text = file.text();
  const std::string_view head = text.substr(0, 4096);
  const std::size_t dataset = head.find("\nDATASET ");
  if (dataset == std::string_view::npos)
  {
    return sizes;
  }
  const std::string_view kind = head.substr(dataset + 9);
  sizes.kind = kind.starts_with("POLYDATA")            ? VtkDataKind::PolyData
               : kind.starts_with("UNSTRUCTURED_GRID") ? VtkDataKind::UnstructuredGrid
                                                       : VtkDataKind::Other;
  sizes.mesh.vertices = sumOfCounts(file, head, "\nPOINTS ", text.size() / 3);
  sizes.mesh.cells = checkLegacyVtkCells(file);
  // VTK's reader of grids takes it for granted that these are there.
  const bool grid = sizes.kind == VtkDataKind::UnstructuredGrid;
  if (sizes.mesh.cells == 0 || (grid && text.find("CELL_TYPES ") == std::string_view::npos))
  {
    file.fail(dataset, "the file has no list of cells that can be read, or not their types");
  }
  return sizes;
}

/** What is cut off need not be missed by VTK: it takes missing appended data for an end. */
void requireXmlEnd(const InputFile& file)
{
  constexpr std::size_t Most = 256;
  const std::string_view text = file.text();
  const std::string_view tail = text.substr(text.size() - std::min(text.size(), Most));
  if (tail.find("</VTKFile>") == std::string_view::npos)
  {
    file.fail(text.size(), "the file does not end with </VTKFile>: it is truncated");
  }
}

VtkSizes xmlSizes(const InputFile& file)
{
  requireXmlEnd(file);
  VtkSizes sizes;
  // What is behind the beginning of the appended data is no XML.
  const std::size_t appended = file.text().find("<AppendedData");
  const std::string_view text = file.text().substr(0, appended);
  sizes.appendedData = appended != std::string_view::npos;
  const std::string_view root = text.substr(std::min(text.find("<VTKFile"), text.size()), 512);
  const std::string_view tag = root.substr(0, root.find('>'));
  sizes.kind = tag.find("\"PolyData\"") != std::string_view::npos ? VtkDataKind::PolyData
               : tag.find("\"UnstructuredGrid\"") != std::string_view::npos
                 ? VtkDataKind::UnstructuredGrid
                 : VtkDataKind::Other;
  const std::uint64_t most = file.size() * LargestCompression;
  sizes.mesh.vertices = sumOfCounts(file, text, "NumberOfPoints", most);
  for (const std::string_view keyword : { "NumberOfCells", "NumberOfPolys", "NumberOfStrips" })
  {
    sizes.mesh.cells += sumOfCounts(file, text, keyword, most);
  }
  sumOfCounts(file, text, " offset=", file.size());
  const VtkXmlArrays arrays = vtkXmlArrays(file, text, most);
  // VTK has the arrays once and the mesh has them once more.
  sizes.mesh.vertexColumnBytes = 2 * arrays.pointBytes;
  sizes.mesh.cellColumnBytes = 2 * arrays.cellBytes;
  return sizes;
}

} // namespace

VtkSizes vtkSizes(const std::filesystem::path& path, MeshFormat format)
{
  const InputFile file(path);
  VtkSizes sizes = format == MeshFormat::VtkLegacy ? legacySizes(file) : xmlSizes(file);
  sizes.mesh.corners = sizes.kind == VtkDataKind::UnstructuredGrid ? 4 : 3;
  // What VTK holds of the mesh while it is taken over.
  sizes.mesh.vertexColumnBytes += 24;
  sizes.mesh.cellColumnBytes += 8 * (sizes.mesh.corners + 1);
  return sizes;
}

} // namespace smg
