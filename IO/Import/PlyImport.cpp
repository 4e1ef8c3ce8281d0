// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Container/NormalsColumn.h"
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/PlyCursor.h"
#include "IO/Import/PlyHeader.h"

#include "Solver/Core/Error.h"

#include <array>
#include <cmath>
#include <cstring>
#include <optional>

namespace smg
{

namespace
{

/** Where the values of a property go. */
struct Target
{
  enum Kind
  {
    Skip,
    Position,
    Attribute,
    Corners
  };
  Kind kind = Skip;
  int column = 0;
  int component = 0;
};

const PlyProperty* findProperty(const PlyElement& element, std::string_view name)
{
  for (const PlyProperty& property : element.properties)
  {
    if (property.name == name && !property.list)
    {
      return &property;
    }
  }
  return nullptr;
}

/** The column of a property that belongs to a group as nx ny nz, if the group is whole. */
std::optional<std::pair<ColumnSpec, int>> group(
  const PlyElement& element, const PlyProperty& property)
{
  struct Group
  {
    const char* column;
    std::array<const char*, 4> names;
    int least;
  };
  constexpr Group groups[] = { { NormalsName, { "nx", "ny", "nz", "" }, 3 },
    { "Colors", { "red", "green", "blue", "alpha" }, 3 } };
  for (const Group& candidate : groups)
  {
    int components = 0;
    int place = -1;
    for (const char* name : candidate.names)
    {
      const PlyProperty* member = findProperty(element, name);
      if (!member || member->type != property.type)
      {
        break;
      }
      place = member == &property ? components : place;
      ++components;
    }
    if (place >= 0 && components >= candidate.least)
    {
      return std::pair{ ColumnSpec{ candidate.column, property.type, components }, place };
    }
  }
  return std::nullopt;
}

/** Gives every property of the element its target, and makes the columns. */
std::vector<Target> targetsOf(const PlyElement& element, bool vertex, std::vector<Column>& columns)
{
  std::vector<Target> targets;
  for (const PlyProperty& property : element.properties)
  {
    Target target;
    if (property.list)
    {
      const bool corners =
        !vertex && (property.name == "vertex_indices" || property.name == "vertex_index");
      target.kind = corners ? Target::Corners : Target::Skip;
    }
    else if (vertex && property.name.size() == 1 && property.name[0] >= 'x' &&
             property.name[0] <= 'z')
    {
      target = { Target::Position, 0, property.name[0] - 'x' };
    }
    else
    {
      const auto [spec, component] =
        group(element, property)
          .value_or(std::pair{ ColumnSpec{ property.name, property.type, 1 }, 0 });
      std::size_t column = 0;
      while (column < columns.size() && columns[column].spec.name != spec.name)
      {
        ++column;
      }
      if (column == columns.size())
      {
        columns.push_back({ spec, {} });
      }
      // A property that has the name of a group is left out where there is that group.
      if (columns[column].spec == spec)
      {
        target = { Target::Attribute, static_cast<int>(column), component };
      }
    }
    targets.push_back(target);
  }
  for (Column& column : columns)
  {
    column.resize(static_cast<std::size_t>(element.count));
  }
  return targets;
}

void store(Column& column, std::int64_t tuple, int component, double value)
{
  std::byte* at = column.bytes.data() + static_cast<std::size_t>(tuple) * column.spec.tupleBytes() +
                  static_cast<std::size_t>(component) * sizeOf(column.spec.type);
  dispatch(column.spec.type,
    [at, value]<class T>(T)
    {
      const T converted = static_cast<T>(value);
      std::memcpy(at, &converted, sizeof(T));
    });
}

/** Reads the body of a PLY file. */
template <class Cursor>
class BodyReader
{
public:
  BodyReader(const PlyHeader& header, Cursor cursor)
    : Header(header)
    , In(std::move(cursor))
  {
    for (const PlyElement& element : header.elements)
    {
      if (element.name == "vertex")
      {
        this->Vertices = element.count;
      }
    }
  }

  IndexedMesh read()
  {
    for (const PlyElement& element : this->Header.elements)
    {
      if (element.name == "vertex")
      {
        this->readVertices(element);
      }
      else if (element.name == "face" || element.name == "tristrips")
      {
        this->readCells(element);
      }
      else
      {
        this->skipElement(element);
      }
    }
    this->Cells.finish(this->Mesh, std::move(this->FaceColumns));
    return std::move(this->Mesh);
  }

private:
  void readVertices(const PlyElement& element)
  {
    const std::vector<Target> targets = targetsOf(element, true, this->Mesh.vertexColumns);
    const PlyProperty* axes[] = { findProperty(element, "x"), findProperty(element, "y"),
      findProperty(element, "z") };
    if (!axes[0] || !axes[1] || !axes[2] || !this->Mesh.positions.empty())
    {
      this->In.fail(this->Mesh.positions.empty() ? "the vertices have no properties x, y and z"
                                                 : "there are two elements 'vertex'");
    }
    this->Mesh.doublePositions = false;
    for (const PlyProperty* axis : axes)
    {
      this->Mesh.doublePositions |= axis->type == ScalarType::Float64 ||
                                    axis->type == ScalarType::Int32 ||
                                    axis->type == ScalarType::UInt32;
    }
    this->Mesh.positions.resize(static_cast<std::size_t>(element.count) * 3);
    for (std::int64_t i = 0; i < element.count; ++i)
    {
      this->readRecord(element, i, targets, this->Mesh.vertexColumns);
    }
  }

  void readCells(const PlyElement& element)
  {
    std::vector<Column> columns;
    const std::vector<Target> targets = targetsOf(element, false, columns);
    const bool first = this->Cells.elements() == 0;
    if (element.name == "face")
    {
      this->Cells.reserve(element.count, 0);
    }
    for (std::int64_t i = 0; i < element.count; ++i)
    {
      this->Polygon.clear();
      this->readRecord(element, i, targets, columns);
      this->takeCell(element.name == "face");
    }
    if (first)
    {
      this->FaceColumns = std::move(columns);
    }
    else
    {
      // Attributes would have to be there for the faces and the strips alike.
      this->FaceColumns.clear();
    }
  }

  void takeCell(bool face)
  {
    for (const std::int64_t corner : this->Polygon)
    {
      if ((corner < 0 && (face || corner != -1)) || corner >= this->Vertices)
      {
        this->In.fail("the corner " + std::to_string(corner) + " is none of the " +
                      std::to_string(this->Vertices) + " vertices");
      }
    }
    if (!face)
    {
      this->Cells.strip(this->Polygon);
    }
    else if (this->Polygon.size() == 3)
    {
      this->Cells.triangle(this->Polygon[0], this->Polygon[1], this->Polygon[2]);
    }
    else
    {
      this->Cells.polygon(this->Polygon);
    }
  }

  void skipElement(const PlyElement& element)
  {
    const std::vector<Target> targets(element.properties.size());
    std::vector<Column> none;
    for (std::int64_t i = 0; i < element.count && !targets.empty(); ++i)
    {
      this->readRecord(element, i, targets, none);
    }
  }

  void readRecord(const PlyElement& element, std::int64_t record,
    const std::vector<Target>& targets, std::vector<Column>& columns)
  {
    this->In.begin(element.name, record);
    for (std::size_t i = 0; i < targets.size(); ++i)
    {
      const PlyProperty& property = element.properties[i];
      const Target& target = targets[i];
      if (property.list)
      {
        this->readList(property, target.kind == Target::Corners);
      }
      else if (target.kind == Target::Skip)
      {
        this->In.skip(property.type, 1);
      }
      else if (target.kind == Target::Position)
      {
        const double value = this->In.read(property.type);
        if (!std::isfinite(value))
        {
          this->In.fail("the coordinate " + property.name + " is not finite");
        }
        this->Mesh.positions[static_cast<std::size_t>(record * 3 + target.component)] = value;
      }
      else
      {
        store(columns[static_cast<std::size_t>(target.column)], record, target.component,
          this->In.read(property.type));
      }
    }
  }

  void readList(const PlyProperty& property, bool corners)
  {
    const auto length = static_cast<std::int64_t>(this->In.read(property.lengthType));
    if (length < 0 || !this->In.holds(property.type, length))
    {
      this->In.fail(length < 0 ? "a list has a negative length"
                               : "the file is truncated, or the list length " +
                                   std::to_string(length) + " is wrong");
    }
    if (!corners)
    {
      this->In.skip(property.type, length);
      return;
    }
    for (std::int64_t i = 0; i < length; ++i)
    {
      const double value = this->In.read(property.type);
      if (!(std::abs(value) < 9e15) || value != std::floor(value))
      {
        this->In.fail("a corner is no integer");
      }
      this->Polygon.push_back(static_cast<std::int64_t>(value));
    }
  }

  const PlyHeader& Header;
  Cursor In;
  std::int64_t Vertices = 0;
  IndexedMesh Mesh;
  CellCollector Cells;
  std::vector<Column> FaceColumns;
  std::vector<std::int64_t> Polygon;
};

/** Refuses counts that the rest of the file is too short for, before anything is allocated. */
void checkLength(const InputFile& file, const PlyHeader& header)
{
  const bool ascii = header.encoding == PlyEncoding::Ascii;
  // The last number of a text needs no line end.
  std::uint64_t left = file.size() - header.bodyOffset + (ascii ? 1 : 0);
  for (const PlyElement& element : header.elements)
  {
    const std::size_t least = element.leastBytes(ascii);
    if (least > 0 && static_cast<std::uint64_t>(element.count) > left / least)
    {
      throw Error(file.path().string() + ": the file is truncated: the header promises " +
                  std::to_string(element.count) + " records of element " + inQuotes(element.name) +
                  ", for which the file of " + std::to_string(file.size()) +
                  " bytes is too short.");
    }
    left -= static_cast<std::uint64_t>(element.count) * least;
  }
}

/** What the header says of the mesh; faces are taken for triangles. */
MeshSizes sizesOf(const PlyHeader& header)
{
  MeshSizes sizes;
  for (const PlyElement& element : header.elements)
  {
    std::int64_t scalars = 0;
    for (const PlyProperty& property : element.properties)
    {
      scalars += property.list ? 0 : static_cast<std::int64_t>(sizeOf(property.type));
    }
    if (element.name == "vertex")
    {
      sizes.vertices = element.count;
      sizes.vertexColumnBytes = scalars;
    }
    else if (element.name == "face")
    {
      sizes.cells = element.count;
      sizes.cellColumnBytes = scalars;
    }
  }
  return sizes;
}

} // namespace

IndexedMesh importPly(InputFile& file, const ImportOptions& options)
{
  const PlyHeader header = readPlyHeader(file);
  checkLength(file, header);
  options.budget.check(file.path(), sizesOf(header));
  return withPlyBody(
    file, header, [&header](auto cursor) { return BodyReader(header, std::move(cursor)).read(); });
}

} // namespace smg
