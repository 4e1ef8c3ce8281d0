// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmBytes.h"

#include "IO/Formats/Vsm/VsmFile.h"
#include "IO/Mesh/Columns.h"

#include <cmath>
#include <vector>

namespace smg
{

namespace
{

// Measured on scans and solids of 40 thousand to 4 million vertices, in breadth-first order. What
// has fewer digits, such as the numbers of a regular grid, is compressed better.

/** What zstd leaves of the bytes of a column. Numbers of single precision keep three quarters in
 * general, coordinates of double precision more than smooth values. Integers are numbers in the
 * original file, or those of parts. */
double compressionOf(ScalarType type)
{
  switch (type)
  {
    case ScalarType::Float32:
      return 0.75;
    case ScalarType::Float64:
      return 0.85;
    case ScalarType::Int64:
    case ScalarType::UInt64:
      return 0.3;
    default:
      return 0.5;
  }
}

/** Bytes of packed numbers, by zstd and not compressed: the last cell of a vertex, and a corner. */
struct PackedBytes
{
  double last, corner, plainLast, plainCorner;
};

PackedBytes packedBytes(CellType cells)
{
  return cells == CellType::Triangle ? PackedBytes{ 0.7, 0.75, 2.9, 2.0 }
                                     : PackedBytes{ 1.45, 1.1, 2.9, 2.0 };
}

/** The columns of a table, of which each row has as many bytes. */
double tableBytes(int table, const std::vector<ColumnSpec>& columns, std::int64_t rows,
  bool isCompressed, const VsmParts& known)
{
  double bytes = 0;
  for (const ColumnSpec& column : columns)
  {
    const auto part = known.find({ table, column.name });
    const double plain = static_cast<double>(rows) * static_cast<double>(column.tupleBytes());
    bytes += !isCompressed         ? plain
             : part == known.end() ? plain * compressionOf(column.type)
                                   : static_cast<double>(part->second);
  }
  return bytes;
}

} // namespace

VsmParts vsmParts(const VsmFile& file)
{
  VsmParts parts;
  const std::vector<TableSpec>& tables = file.Blocks.tables();
  for (int table = 0; file.Blocks.codec() == Codec::Zstd && table < VsmFormat::Blocks; ++table)
  {
    const std::vector<ColumnSpec>& columns = tables[static_cast<std::size_t>(table)].columns;
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      parts[{ table, columns[c].name }] = file.Blocks.storedBytes(table, static_cast<int>(c));
    }
  }
  return parts;
}

std::int64_t vsmBytes(const StreamInfo& mesh, Codec codec, const VsmParts& known)
{
  const bool isCompressed = codec != Codec::None;
  const auto packed = [&](int table, const char* name, std::int64_t numbers, double bytes)
  {
    const auto part = known.find({ table, name });
    return isCompressed && part != known.end() ? static_cast<double>(part->second)
                                               : static_cast<double>(numbers) * bytes;
  };
  std::vector<ColumnSpec> ofVertices = mesh.vertexColumns;
  ofVertices.push_back({ "Position", positionType(mesh.doublePositions), 3 });
  const PackedBytes rates = packedBytes(mesh.cellType);
  const double bytes =
    tableBytes(VsmFormat::Vertices, ofVertices, mesh.vertices, isCompressed, known) +
    tableBytes(VsmFormat::Cells, mesh.cellColumns, mesh.cells, isCompressed, known) +
    packed(
      VsmFormat::Last, "LastCell", mesh.vertices, isCompressed ? rates.last : rates.plainLast) +
    packed(VsmFormat::Cells, "Corners", mesh.cells * cornersOf(mesh.cellType),
      isCompressed ? rates.corner : rates.plainCorner);
  constexpr double Lz4Growth = 1.2; // packed numbers grow most
  return std::llround(bytes * (codec == Codec::Lz4 ? Lz4Growth : 1.0));
}

} // namespace smg
