// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/MeshFileWriter.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

// PLY, in binary in this machine's byte order or as text. Columns become properties of the vertices
// or faces, named so that importPly() restores the same columns: `Normals` of 3 components nx, ny,
// nz; `TextureCoordinates` of 2 texture_u, texture_v; `Colors` of 3 or 4 red, green, blue, alpha; a
// column of one component its own name, and one of several NAME_0, NAME_1 ..., which come back as
// columns of their own. What is no visible ASCII character in a name becomes an underscore, and a
// name whose property another column or the mesh has is followed by _1, _2 ...; columns that need
// no other name keep theirs. PLY has no 64-bit integers: they are written, and come back, as
// double, which is exact up to 2^53. So convert() takes the `OriginalId` of a PLY file for an
// attribute (see there): its own are the places in the PLY file.

namespace smg
{

std::string plyFormatLines(bool text)
{
  const bool little = std::endian::native == std::endian::little;
  const std::string form = text ? "ascii" : little ? "binary_little_endian" : "binary_big_endian";
  return "ply\nformat " + form + " 1.0\n";
}

namespace
{

/** The changes to the columns of a mesh written as PLY. */
struct WrittenPly
{
  /** Columns with another name in the file, and that name. */
  std::vector<std::pair<std::string, std::string>> renamedColumns;
  /** Columns of several components that are as many properties, and how many. */
  std::vector<std::pair<std::string, int>> splitColumns;
  /** Columns of 64-bit integers with values beyond 2^53, which were rounded. */
  std::vector<std::string> roundedColumns;
};

/** A sentence per column. */
WriteNotes notesOn(const WrittenPly& written)
{
  WriteNotes notes;
  for (const auto& [column, name] : written.renamedColumns)
  {
    notes.push_back(
      "The column " + inQuotes(column) + " is called " + inQuotes(name) + " in the file.");
  }
  for (const auto& [name, components] : written.splitColumns)
  {
    notes.push_back("The column " + inQuotes(name) + " of " + std::to_string(components) +
                    " components comes back as the columns " + inQuotes(name + "_0") + " to " +
                    inQuotes(name + '_' + std::to_string(components - 1)) + '.');
  }
  for (const std::string& name : written.roundedColumns)
  {
    notes.push_back("Values of the column " + inQuotes(name) +
                    " were rounded to double, since PLY has no 64-bit integers.");
  }
  return notes;
}

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
  if (spec.name == TextureCoordinatesName && name == spec.name && spec.components == 2)
  {
    return { "texture_u", "texture_v" };
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

/** An element of a PLY file whose records all have the same size: its part of the header, and its
 * records, made from columns. Columns of 64-bit integers become double. */
class PlyRecords
{
public:
  /** The element `name` with `count` records. */
  PlyRecords(const std::string& name, std::int64_t count)
    : Header("element " + name + ' ' + std::to_string(count) + '\n')
  {
  }

  /** Adds the lists of corners, which precede the records and are no part of them. */
  void addCorners(const std::string& lengthType)
  {
    this->Names.emplace_back("vertex_indices");
    this->Header += "property list " + lengthType + " int vertex_indices\n";
  }
  /** Adds the coordinates x, y and z. */
  void addPositions(ScalarType type)
  {
    for (const char* name : { "x", "y", "z" })
    {
      this->Names.emplace_back(name);
      this->addProperty(type, name);
    }
  }
  /** Adds the properties of columns. Other names are noted. */
  void add(const std::vector<ColumnSpec>& columns, WrittenPly& written)
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
      if (names[i].front() == name + "_0")
      {
        written.splitColumns.emplace_back(name, columns[i].components);
      }
      const ScalarType type =
        isLongInteger(columns[i].type) ? ScalarType::Float64 : columns[i].type;
      this->Places.push_back(static_cast<std::ptrdiff_t>(this->RecordBytes));
      for (const std::string& property : names[i])
      {
        this->addProperty(type, property);
      }
    }
  }

  const std::string& header() const { return this->Header; }
  std::size_t recordBytes() const { return this->RecordBytes; }
  /** About the characters of a record as text. */
  double recordCharacters() const
  {
    double characters = 0;
    for (const ScalarType type : this->Types)
    {
      const ColumnSpec number{ "", type, 1 };
      characters += tupleCharacters({ &number, 1 }, 0);
    }
    return characters;
  }

  /** Makes `count` records, whose fields must be filled. */
  void begin(std::size_t count) { this->Records.resize(count * this->RecordBytes); }
  /** Fills in tuples of `bytes` bytes, one per record, at a position of the record. */
  void fill(std::ptrdiff_t place, std::span<const std::byte> tuples, std::size_t bytes)
  {
    const std::byte* from = tuples.data();
    std::byte* const end = this->Records.data() + this->Records.size();
    for (std::byte* record = this->Records.data(); record < end; record += this->RecordBytes)
    {
      std::memcpy(record + place, from, bytes);
      from += bytes;
    }
  }

  /** Fills in the columns that were added. Rounded values are noted. */
  void fill(const std::vector<Column>& columns, WrittenPly& written)
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

  std::span<const std::byte> records() const { return this->Records; }
  /** Writes the numbers of a record as text, with a blank before each but the first of a line. */
  void write(TextOutput& out, std::size_t record, bool beginsLine) const
  {
    const std::byte* from = this->Records.data() + record * this->RecordBytes;
    for (const ScalarType type : this->Types)
    {
      if (!beginsLine)
      {
        out << ' ';
      }
      beginsLine = false;
      dispatch(type,
        [&]<class T>(T number)
        {
          std::memcpy(&number, from, sizeof(number));
          out << number;
          from += sizeof(number);
        });
    }
  }

private:
  void addProperty(ScalarType type, const std::string& name)
  {
    this->Header += "property " + std::string(plyTypeName(type)) + ' ' + name + '\n';
    this->Types.push_back(type);
    this->RecordBytes += sizeOf(type);
  }
  /** Whether no property has one of these names. */
  bool areFree(const std::vector<std::string>& names) const
  {
    return std::ranges::none_of(names, [this](const std::string& name)
      { return std::ranges::find(this->Names, name) != this->Names.end(); });
  }

  /** Returns whether a value was rounded. */
  bool fill(std::ptrdiff_t place, const Column& column)
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

  std::string Header;
  std::vector<std::string> Names;
  std::vector<ScalarType> Types; ///< of the numbers of a record
  std::size_t RecordBytes = 0;
  std::vector<std::ptrdiff_t> Places; ///< of each column in the record
  std::vector<std::byte> Records;
  std::vector<double> Doubles;
};

/** Throws Error if there are more vertices than PLY has numbers for. */
const std::filesystem::path& checkedForPly(const std::filesystem::path& path, std::int64_t vertices)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices > most)
  {
    throw Error(path.string() + ": PLY has room for " + std::to_string(most) +
                " vertices, but there are " + std::to_string(vertices) + ": choose .vsm or .vtp.");
  }
  return path;
}

/** The elements of a PLY file, as their header describes them. */
class PlyElements : public MeshFileWriter
{
protected:
  explicit PlyElements(const MeshFileInfo& info)
    : Positions(info.doublePositions)
    , Vertices("vertex", info.vertices)
    , Faces("face", info.elements)
    , CountBytes(info.maxCorners > UINT8_MAX ? sizeof(std::int32_t) : 1)
  {
    this->Vertices.addPositions(this->Positions.type());
    this->Faces.addCorners(this->CountBytes > 1 ? "int" : "uchar");
    this->Vertices.add(info.vertexColumns, this->Written);
    this->Faces.add(info.elementColumns, this->Written);
  }

  std::string header(bool text) const
  {
    return plyFormatLines(text) + this->Vertices.header() + this->Faces.header() + "end_header\n";
  }
  void fillVertices(const VertexChunk& chunk)
  {
    this->Vertices.begin(static_cast<std::size_t>(chunk.count()));
    this->Vertices.fill(0, this->Positions.bytes(chunk.positions), this->Positions.size());
    this->Vertices.fill(chunk.columns, this->Written);
  }
  void fillFaces(const ElementChunk& chunk)
  {
    this->Faces.begin(chunk.sizes.size());
    this->Faces.fill(chunk.columns, this->Written);
  }

  FilePositions Positions;
  PlyRecords Vertices, Faces;
  const std::size_t CountBytes; ///< of the number of the corners of a face
  WrittenPly Written;
};

/** Writes text, the vertices first. */
class TextPlyWriter : public PlyElements
{
public:
  TextPlyWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : PlyElements(info)
    , Out(checkedForPly(path, info.vertices))
  {
    this->Out << this->header(true);
  }

  void vertices(const VertexChunk& chunk) override
  {
    this->fillVertices(chunk);
    for (std::int64_t vertex = 0; vertex < chunk.count(); ++vertex)
    {
      this->Vertices.write(this->Out, static_cast<std::size_t>(vertex), true);
      this->Out << '\n';
    }
  }

  void elements(const ElementChunk& chunk) override
  {
    this->fillFaces(chunk);
    chunk.forEach(
      [this](std::span<const std::int64_t> corners, std::size_t face)
      {
        this->Out << corners.size();
        this->Out.corners(corners, 0);
        this->Faces.write(this->Out, face, false);
        this->Out << '\n';
      });
  }

  WriteNotes finish() override
  {
    this->Out.finish();
    return notesOn(this->Written);
  }

private:
  TextOutput Out;
};

/** Writes binary: vertices and faces at their places, which are known from the counts. */
class BinaryPlyWriter : public PlyElements
{
public:
  BinaryPlyWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : PlyElements(info)
    , File(checkedForPly(path, info.vertices))
  {
    const std::string header = this->header(false);
    this->write(std::as_bytes(std::span(header)), this->VertexEnd);
    const std::size_t faceBytes = this->CountBytes + this->Faces.recordBytes();
    this->FaceEnd =
      this->VertexEnd + info.vertices * static_cast<std::int64_t>(this->Vertices.recordBytes());
    this->File.reserve(this->FaceEnd + info.elements * static_cast<std::int64_t>(faceBytes) +
                       info.corners * static_cast<std::int64_t>(sizeof(std::int32_t)));
  }

  void vertices(const VertexChunk& chunk) override
  {
    this->fillVertices(chunk);
    this->write(this->Vertices.records(), this->VertexEnd);
  }

  void elements(const ElementChunk& chunk) override
  {
    const std::size_t faces = chunk.sizes.size();
    const std::size_t recordBytes = this->Faces.recordBytes();
    this->fillFaces(chunk);
    this->Lists.resize(
      faces * (this->CountBytes + recordBytes) + chunk.corners.size() * sizeof(std::int32_t));
    std::byte* to = this->Lists.data();
    const auto put = [&to](const auto& value)
    {
      std::memcpy(to, &value, sizeof(value));
      to += sizeof(value);
    };
    chunk.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t face)
      {
        this->CountBytes > 1 ? put(static_cast<std::int32_t>(corners.size()))
                             : put(static_cast<std::uint8_t>(corners.size()));
        for (const std::int64_t corner : corners)
        {
          put(static_cast<std::int32_t>(corner));
        }
        to = std::copy_n(this->Faces.records().data() + recordBytes * face, recordBytes, to);
      });
    this->write(this->Lists, this->FaceEnd);
  }

  WriteNotes finish() override
  {
    this->File.finish();
    return notesOn(this->Written);
  }

private:
  void write(std::span<const std::byte> bytes, std::int64_t& at)
  {
    this->File.write(at, bytes);
    at += static_cast<std::int64_t>(bytes.size());
  }

  PositionedFile File;
  std::int64_t VertexEnd = 0, FaceEnd = 0;
  std::vector<std::byte> Lists; ///< of corners, with the records
};

} // namespace

std::unique_ptr<MeshFileWriter> makePlyWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace*)
{
  if (info.text)
  {
    return std::make_unique<TextPlyWriter>(path, info);
  }
  return std::make_unique<BinaryPlyWriter>(path, info);
}

std::int64_t bytesOfPly(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  PlyRecords vertices("vertex", mesh.vertices), faces("face", mesh.cells);
  WrittenPly ignored;
  vertices.addPositions(positionType(mesh.doublePositions));
  vertices.add(mesh.vertexColumns, ignored);
  faces.add(mesh.cellColumns, ignored);
  if (written.text)
  {
    const double corners = 2 + 3 * numberCharacters(mesh.vertices);
    return textBytes(mesh.vertices, vertices.recordCharacters()) +
           textBytes(mesh.cells, corners + faces.recordCharacters());
  }
  constexpr std::int64_t CornersBytes = 1 + 3 * sizeof(std::int32_t);
  return mesh.vertices * static_cast<std::int64_t>(vertices.recordBytes()) +
         mesh.cells * (CornersBytes + static_cast<std::int64_t>(faces.recordBytes()));
}

} // namespace smg
