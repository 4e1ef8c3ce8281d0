// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/WritePly.h"

#include "IO/Export/RestoredMesh.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

namespace smg
{

namespace
{

/**
 * Writes the stream; all records of an element have the same size, so their positions are known.
 */
class PlyWriter
{
public:
  PlyWriter(const StreamInfo& info, const std::filesystem::path& path)
    : Info(info)
    , File(path)
    , Vertices("vertex", info.vertices)
    , Faces("face", info.cells)
  {
    this->Vertices.addPositions(info.doublePositions);
    this->Faces.add("list uchar int vertex_indices", 1 + 3 * sizeof(std::int32_t));
    this->Vertices.add(info.vertexColumns, this->Written);
    this->Faces.add(info.cellColumns, this->Written);
    const std::string header =
      plyFormatLines() + this->Vertices.header() + this->Faces.header() + "end_header\n";
    this->File.write(0, std::as_bytes(std::span(header)));
    this->VertexEnd = static_cast<std::int64_t>(header.size());
    this->FirstFace = this->FaceEnd =
      this->VertexEnd + info.vertices * static_cast<std::int64_t>(this->Vertices.recordBytes());
    this->File.reserve(
      this->FirstFace + info.cells * static_cast<std::int64_t>(this->Faces.recordBytes()));
  }

  void append(const MeshBlock& block)
  {
    this->Vertices.begin(static_cast<std::size_t>(block.vertices()));
    this->Vertices.fillPositions(block.positions);
    this->Vertices.fill(block.vertexColumns, this->Written);
    this->write(this->Vertices, this->VertexEnd);

    this->Corners.assign(block.corners.begin(), block.corners.end());
    this->Counts.assign(this->Corners.size() / 3, std::byte(3));
    this->Faces.begin(this->Counts.size());
    this->Faces.fill(0, this->Counts, 1);
    this->Faces.fill(1, std::as_bytes(std::span(this->Corners)), 3 * sizeof(std::int32_t));
    this->Faces.fill(block.cellColumns, this->Written);
    this->write(this->Faces, this->FaceEnd);
  }

  WrittenPly finish(const std::filesystem::path& path)
  {
    const std::int64_t end =
      this->FirstFace + this->Info.cells * static_cast<std::int64_t>(this->Faces.recordBytes());
    if (this->VertexEnd != this->FirstFace || this->FaceEnd != end)
    {
      throw Error(otherCounts(path.string(), this->Info));
    }
    this->File.finish();
    return this->Written;
  }

private:
  void write(const PlyRecords& records, std::int64_t& at)
  {
    this->File.write(at, records.records());
    at += static_cast<std::int64_t>(records.records().size());
  }

  const StreamInfo& Info;
  PositionedFile File;
  PlyRecords Vertices, Faces;
  std::int64_t VertexEnd = 0, FirstFace = 0, FaceEnd = 0;
  std::vector<std::int32_t> Corners;
  std::vector<std::byte> Counts; ///< of corners, each 3
  WrittenPly Written;
};

} // namespace

std::vector<std::string> notesOn(const WrittenPly& written)
{
  std::vector<std::string> notes;
  for (const auto& [column, name] : written.renamedColumns)
  {
    notes.push_back(
      "The column " + inQuotes(column) + " is called " + inQuotes(name) + " in the file.");
  }
  for (const std::string& name : written.roundedColumns)
  {
    notes.push_back("Values of the column " + inQuotes(name) +
                    " were rounded to double, since PLY has no 64-bit integers.");
  }
  return notes;
}

void checkPlyVertices(const std::filesystem::path& path, std::int64_t vertices)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices > most)
  {
    throw Error(path.string() + ": PLY has room for " + std::to_string(most) +
                " vertices, but there are " + std::to_string(vertices) + ": choose .vsm or .vtp.");
  }
}

WrittenPly writePly(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  checkPlyVertices(path, info.vertices);
  Progress reported(progress);
  PlyWriter writer(info, path);
  for (MeshBlock block; source.next(block);)
  {
    writer.append(block);
    const auto end =
      static_cast<double>(block.firstCell) + static_cast<double>(block.corners.size()) / 3.0;
    reported.update(end / static_cast<double>(info.cells));
  }
  return writer.finish(path);
}

namespace
{

bool isLongInteger(ScalarType type)
{
  return type == ScalarType::Int64 || type == ScalarType::UInt64;
}

/** A name of visible ASCII characters. */
std::string plyName(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c >= 127; }, '_');
  return name;
}

/** The names of the properties of a column that has this name in the file. */
std::vector<std::string> namesOf(const ColumnSpec& spec, const std::string& name)
{
  if (isNormals(spec) && name == spec.name)
  {
    return { "nx", "ny", "nz" };
  }
  if (spec.name == ColorsName && name == spec.name && spec.components == 3)
  {
    return { "red", "green", "blue" };
  }
  if (spec.name == ColorsName && name == spec.name && spec.components == 4)
  {
    return { "red", "green", "blue", "alpha" };
  }
  if (spec.components == 1)
  {
    return { name };
  }
  std::vector<std::string> names;
  for (int k = 0; k < spec.components; ++k)
  {
    names.push_back(name + '_' + std::to_string(k));
  }
  return names;
}

/** Whether a double can represent a 64-bit integer. */
template <class T>
bool isExact(T value, double converted)
{
  // The largest integers are rounded to 2^63 and 2^64.
  constexpr double end = std::is_signed_v<T> ? 0x1p63 : 0x1p64;
  return converted < end && static_cast<T>(converted) == value;
}

} // namespace

std::string plyFormatLines()
{
  const bool little = std::endian::native == std::endian::little;
  return std::string("ply\nformat binary_") + (little ? "little" : "big") + "_endian 1.0\n";
}

PlyRecords::PlyRecords(const std::string& name, std::int64_t count)
  : Header("element " + name + ' ' + std::to_string(count) + '\n')
{
}

void PlyRecords::addPositions(bool isDouble)
{
  this->DoublePositions = isDouble;
  for (const char* name : { "x", "y", "z" })
  {
    const ScalarType type = isDouble ? ScalarType::Float64 : ScalarType::Float32;
    this->add(std::string(plyTypeName(type)) + ' ' + name, sizeOf(type));
  }
}

void PlyRecords::add(const std::vector<ColumnSpec>& columns, WrittenPly& written)
{
  // Columns that can keep their names do so, whatever others would be called.
  std::vector<std::vector<std::string>> names(columns.size());
  const auto choose = [&](std::size_t i, const std::string& name)
  {
    const std::vector<std::string> chosen = namesOf(columns[i], name);
    if (!this->areFree(chosen))
    {
      return false;
    }
    this->Names.insert(this->Names.end(), chosen.begin(), chosen.end());
    names[i] = chosen;
    return true;
  };
  for (const bool severalProperties : { false, true })
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const std::string& name = columns[i].name;
      if ((columns[i].components > 1) == severalProperties && plyName(name) == name)
      {
        choose(i, name);
      }
    }
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const std::string base = plyName(columns[i].name);
    std::string name = base;
    for (int k = 1; names[i].empty() && !choose(i, name); ++k)
    {
      name = base + '_' + std::to_string(k);
    }
    if (name != columns[i].name)
    {
      written.renamedColumns.emplace_back(columns[i].name, name);
    }
    const ScalarType type = isLongInteger(columns[i].type) ? ScalarType::Float64 : columns[i].type;
    this->Places.push_back(static_cast<std::ptrdiff_t>(this->RecordBytes));
    for (const std::string& property : names[i])
    {
      this->addProperty(std::string(plyTypeName(type)) + ' ' + property, sizeOf(type));
    }
  }
}

/** Whether no property has one of these names. */
bool PlyRecords::areFree(const std::vector<std::string>& names) const
{
  return std::ranges::none_of(names, [this](const std::string& name)
    { return std::ranges::find(this->Names, name) != this->Names.end(); });
}

void PlyRecords::addProperty(const std::string& property, std::size_t bytes)
{
  this->Header += "property " + property + '\n';
  this->RecordBytes += bytes;
}

void PlyRecords::add(const std::string& property, std::size_t bytes)
{
  this->Names.push_back(property.substr(property.rfind(' ') + 1));
  this->addProperty(property, bytes);
}

void PlyRecords::begin(std::size_t count)
{
  this->Records.resize(count * this->RecordBytes);
}

void PlyRecords::fill(std::ptrdiff_t place, std::span<const std::byte> tuples, std::size_t bytes)
{
  const std::byte* from = tuples.data();
  std::byte* const end = this->Records.data() + this->Records.size();
  for (std::byte* record = this->Records.data(); record < end; record += this->RecordBytes)
  {
    std::memcpy(record + place, from, bytes);
    from += bytes;
  }
}

void PlyRecords::fillPositions(std::span<const double> positions)
{
  if (this->DoublePositions)
  {
    this->fill(0, std::as_bytes(positions), 3 * sizeof(double));
    return;
  }
  this->Single.assign(positions.begin(), positions.end());
  this->fill(0, std::as_bytes(std::span(this->Single)), 3 * sizeof(float));
}

void PlyRecords::fill(const std::vector<Column>& columns, WrittenPly& written)
{
  std::vector<std::string>& rounded = written.roundedColumns;
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    const std::string& name = columns[i].spec.name;
    if (this->fill(this->Places[i], columns[i]) &&
        std::find(rounded.begin(), rounded.end(), name) == rounded.end())
    {
      rounded.push_back(name);
    }
  }
}

/** Returns whether a value was rounded. */
bool PlyRecords::fill(std::ptrdiff_t place, const Column& column)
{
  if (!isLongInteger(column.spec.type))
  {
    this->fill(place, column.bytes, column.spec.tupleBytes());
    return false;
  }
  bool exact = true;
  const auto convert = [this, &exact]<class T>(std::span<const T> values)
  {
    this->Doubles.assign(values.begin(), values.end());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      exact = exact && isExact(values[i], this->Doubles[i]);
    }
  };
  column.spec.type == ScalarType::Int64 ? convert(column.as<std::int64_t>())
                                        : convert(column.as<std::uint64_t>());
  this->fill(place, std::as_bytes(std::span(this->Doubles)),
    sizeof(double) * static_cast<std::size_t>(column.spec.components));
  return !exact;
}

namespace
{

/** Writes the vertices, then the faces, whose records have different sizes. */
class RestoredPlyWriter
{
public:
  RestoredPlyWriter(const RestoredInfo& info, const std::filesystem::path& path)
    : Info(info)
    , Out(path)
    , Vertices("vertex", info.vertices)
    , Faces("face", info.elements)
    , ManyCorners(info.maxCorners > UINT8_MAX)
  {
    this->Vertices.addPositions(info.doublePositions);
    // The list precedes each record and is not part of it.
    this->Faces.add(
      this->ManyCorners ? "list int int vertex_indices" : "list uchar int vertex_indices", 0);
  }

  WrittenPly write(RestoredMesh& mesh)
  {
    WrittenPly written;
    this->Vertices.add(this->Info.vertexColumns, written);
    this->Faces.add(this->Info.elementColumns, written);
    this->Out.put(
      plyFormatLines() + this->Vertices.header() + this->Faces.header() + "end_header\n");
    for (RestoredVertices vertices; mesh.next(vertices);)
    {
      this->Vertices.begin(static_cast<std::size_t>(vertices.count()));
      this->Vertices.fillPositions(vertices.positions);
      this->Vertices.fill(vertices.columns, written);
      this->Out.put(this->Vertices.records());
    }
    for (RestoredElements elements; mesh.next(elements);)
    {
      this->Faces.begin(elements.sizes.size());
      this->Faces.fill(elements.columns, written);
      this->writeFaces(elements);
    }
    this->Out.finish();
    return written;
  }

private:
  void writeFaces(const RestoredElements& elements)
  {
    this->Bytes.clear();
    elements.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t face)
      {
        const auto count = static_cast<std::int32_t>(corners.size());
        this->ManyCorners ? this->add(&count, sizeof(count))
                          : this->add(std::array{ static_cast<std::uint8_t>(count) }.data(), 1);
        for (const std::int64_t corner : corners)
        {
          const auto number = static_cast<std::int32_t>(corner);
          this->add(&number, sizeof(number));
        }
        const std::size_t bytes = this->Faces.recordBytes();
        this->add(this->Faces.records().data() + bytes * face, bytes);
      });
    this->Out.put(this->Bytes);
  }

  void add(const void* bytes, std::size_t count)
  {
    const auto* const first = static_cast<const std::byte*>(bytes);
    this->Bytes.insert(this->Bytes.end(), first, first + count);
  }

  const RestoredInfo& Info;
  SequentialOutput Out;
  PlyRecords Vertices, Faces;
  const bool ManyCorners; ///< whether a face has more corners than a byte can count
  std::vector<std::byte> Bytes;
};

} // namespace

WriteNotes writeRestoredPly(RestoredMesh& mesh, const std::filesystem::path& path)
{
  checkPlyVertices(path, mesh.info().vertices);
  return notesOn(RestoredPlyWriter(mesh.info(), path).write(mesh));
}

} // namespace smg
