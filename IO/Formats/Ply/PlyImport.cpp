// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Ply/PlyCursor.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** Reads the body of a PLY file. */
template <class Cursor>
class BodyReader
{
public:
  BodyReader(const PlyHeader& header, Cursor& cursor, RawMeshBuilder& builder)
    : Header(header)
    , In(cursor)
    , Builder(builder)
  {
  }

  void read()
  {
    this->Builder.numberVertices(0, this->Header.vertices());
    for (const PlyElement& element : this->Header.elements)
    {
      this->readElement(element);
    }
    if (!this->In.atEnd())
    {
      throw MeshError("there is more after the last record: the counts of the header are wrong");
    }
  }

private:
  using Columns = std::vector<ImportColumn>;

  void readElement(const PlyElement& element)
  {
    if (element.name == "vertex")
    {
      this->readVertices(element);
    }
    else if (element.properties.empty() || element.count == 0)
    {
      return; // the body has no bytes of it, for any number of records
    }
    else if (element.name == "face")
    {
      this->readCells<false>(element);
    }
    else if (element.name == "tristrips")
    {
      this->readCells<true>(element);
    }
    else
    {
      this->readRecords<false>(element, planOf(element, PlyRole::Others), [] {});
    }
  }

  void readVertices(const PlyElement& element)
  {
    const PlyProperty* axes[] = { findNumber(element, "x"), findNumber(element, "y"),
      findNumber(element, "z") };
    if (!axes[0] || !axes[1] || !axes[2] || this->HasVertices)
    {
      throw MeshError(this->HasVertices ? "there are two elements 'vertex'"
                                        : "the vertices have no properties x, y and z");
    }
    this->HasVertices = true;
    bool single = true;
    for (const PlyProperty* axis : axes)
    {
      single &= axis->type != ScalarType::Float64 && axis->type != ScalarType::Int32 &&
                axis->type != ScalarType::UInt32;
    }
    if (single)
    {
      this->Builder.useSinglePrecision();
    }
    Columns columns;
    const PlyPlan plan = planOf(element, PlyRole::Vertices,
      [&](const ColumnSpec& spec) { return this->add(columns, ColumnOf::Vertices, spec); });
    this->readRecords<false>(element, plan,
      [this, &plan, &columns]
      {
        this->Builder.vertex(this->Position[0], this->Position[1], this->Position[2]);
        this->append(plan, columns);
      });
  }

  template <bool IsStrip>
  void readCells(const PlyElement& element)
  {
    // Attributes would be required for both faces and strips.
    const bool alone = !std::exchange(this->HasCells, true);
    const PlyPlan plan = planOf(element, PlyRole::Cells,
      [this, alone](const ColumnSpec& spec)
      {
        if (!alone)
        {
          this->CellColumns.emplace_back();
          return -1;
        }
        return this->add(this->CellColumns, ColumnOf::Elements, spec);
      });
    if (!alone && !this->CellColumns.empty())
    {
      this->Builder.note("The attributes of the faces are left out, since the file has several "
                         "elements of cells, which do not share them.");
      std::ranges::for_each(this->CellColumns, &ImportColumn::drop);
      this->CellColumns.clear();
    }
    const bool hasCorners =
      std::ranges::any_of(plan.steps, [](auto& step) { return step.kind == PlyStep::Corners; });
    this->readRecords<IsStrip>(element, plan,
      [this, &plan, hasCorners]
      {
        if (!hasCorners)
        {
          this->Builder.dropped();
        }
        this->append(plan, this->CellColumns);
      });
  }

  /** The number of a new column among `columns`; -1 if the mesh cannot have it. */
  int add(Columns& columns, ColumnOf of, const ColumnSpec& spec)
  {
    columns.emplace_back(this->Builder, of, spec);
    return columns.back().exists() ? static_cast<int>(columns.size()) - 1 : -1;
  }

  /** Appends the attributes of a record. */
  void append(const PlyPlan& plan, Columns& columns) const
  {
    for (const PlyTuple& tuple : plan.tuples)
    {
      columns[std::size_t(tuple.column)].append(
        std::span(this->Attributes).subspan(tuple.begin, tuple.bytes));
    }
  }

  /** Calls `take` after each record. */
  template <bool IsStrip, class Take>
  void readRecords(const PlyElement& element, const PlyPlan& plan, Take&& take)
  {
    this->Attributes.resize(plan.attributeBytes);
    for (std::int64_t i = 0; i < element.count; ++i)
    {
      this->In.begin(element.name, i);
      for (const PlyStep& step : plan.steps)
      {
        this->doStep<IsStrip>(step);
      }
      take();
    }
  }

  template <bool IsStrip>
  void doStep(const PlyStep& step)
  {
    switch (step.kind)
    {
      case PlyStep::Coordinate:
        this->Position[step.place] = this->In.read(step.type);
        break;
      case PlyStep::Attribute:
        dispatch(step.type,
          [this, &step]<class T>(T)
          {
            const T value = this->In.template take<T>();
            std::memcpy(this->Attributes.data() + step.place, &value, sizeof(T));
          });
        break;
      case PlyStep::Skip:
        this->In.skip(step.type, step.count);
        break;
      case PlyStep::SkipList:
        this->In.skip(step.type, readPlyLength(this->In, step.lengthType, step.type));
        break;
      case PlyStep::Corners:
        dispatch(step.type,
          [this, length = readPlyLength(this->In, step.lengthType, step.type)]<class T>(T)
          { this->readCorners<T, IsStrip>(length); });
        break;
    }
  }

  template <class T, bool IsStrip>
  void readCorners(std::int64_t length)
  {
    if (!IsStrip && length == 3)
    {
      const std::int64_t a = this->readCorner<T>();
      const std::int64_t b = this->readCorner<T>();
      this->Builder.triangle(a, b, this->readCorner<T>());
      return;
    }
    for (std::int64_t i = 0; i < length; ++i)
    {
      const std::int64_t corner = this->readCorner<T>();
      if (!IsStrip)
      {
        this->Builder.fanCorner(corner);
      }
      else
      {
        corner == -1 ? this->Builder.endStrip() : this->Builder.stripCorner(corner);
      }
    }
    this->Builder.endTriangles();
  }

  template <class T>
  std::int64_t readCorner()
  {
    const T value = this->In.template take<T>();
    if constexpr (std::is_floating_point_v<T>)
    {
      if (!(std::abs(value) < T(9e15)) || value != std::floor(value))
      {
        throw MeshError("a corner is not an integer");
      }
    }
    return static_cast<std::int64_t>(value);
  }

  const PlyHeader& Header;
  Cursor& In;
  RawMeshBuilder& Builder;
  bool HasVertices = false, HasCells = false;
  Columns CellColumns;
  std::array<double, 3> Position{};
  std::vector<std::byte> Attributes; ///< of a record
};

/** Refuses counts that exceed the rest of the file. */
void checkLength(const InputFile& file, const PlyHeader& header)
{
  std::size_t left = file.size() - header.bodyOffset;
  for (const PlyElement& element : header.elements)
  {
    const std::size_t least = element.minBytes(header.encoding == PlyEncoding::Ascii);
    if (!fitsInFile(element.count, least, left))
    {
      file.fail(
        header.bodyOffset, countError(element.count,
                             "the number of records of element " + inQuotes(element.name), left));
    }
    left -= std::min(left, static_cast<std::size_t>(element.count) * least);
  }
}

void noteLeftOut(const PlyHeader& header, RawMeshBuilder& builder)
{
  const std::vector<std::string> leftOut = leftOutOf(header);
  constexpr std::size_t MostNames = 10;
  std::string names;
  for (std::size_t i = 0; i < std::min(leftOut.size(), MostNames); ++i)
  {
    names += (i == 0 ? " " : ", ") + leftOut[i];
  }
  if (!names.empty())
  {
    builder.note("Left out, since a mesh has no place for them:" + names +
                 (leftOut.size() > MostNames ? " ..." : "."));
  }
}

} // namespace

void importPly(InputFile& file, RawMeshBuilder& builder)
{
  const PlyHeader header = readPlyHeader(file);
  checkLength(file, header);
  for (const std::string& keyword : header.unknown)
  {
    builder.note("The line of the header that begins with " + inQuotes(keyword) +
                 " is none of PLY and is left out.");
  }
  noteLeftOut(header, builder);
  withPlyBody(file, header, &builder.workspace(),
    [&](auto& cursor) { BodyReader(header, cursor, builder).read(); });
}

} // namespace smg
