// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Ply/PlyCursor.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Import/TriangleRuns.h"
#include "smg/Error.h"

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
  BodyReader(const PlyHeader& header, Cursor cursor, RawMeshBuilder& builder)
    : Header(header)
    , In(std::move(cursor))
    , Builder(builder)
    , Fan(builder)
    , Strip(builder)
  {
    for (const PlyElement& element : header.elements)
    {
      this->Vertices = element.name == "vertex" ? element.count : this->Vertices;
    }
  }

  void read()
  {
    try
    {
      for (const PlyElement& element : this->Header.elements)
      {
        this->readElement(element);
      }
      if (!this->In.atEnd())
      {
        this->In.fail("there is more after the last record: the counts of the header are wrong");
      }
    }
    catch (const MeshError& error)
    {
      this->In.fail(error.what());
    }
  }

private:
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
      this->readCells(element, this->Fan);
    }
    else if (element.name == "tristrips")
    {
      this->readCells(element, this->Strip);
    }
    else
    {
      this->readRecords(element, planOf(element, PlyRole::Others), this->Fan, [] {});
    }
  }

  void readVertices(const PlyElement& element)
  {
    const PlyProperty* axes[] = { findNumber(element, "x"), findNumber(element, "y"),
      findNumber(element, "z") };
    if (!axes[0] || !axes[1] || !axes[2] || this->HasVertices)
    {
      this->In.fail(this->HasVertices ? "there are two elements 'vertex'"
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
    const PlyPlan plan = planOf(element, PlyRole::Vertices,
      [this](const ColumnSpec& spec) { return this->Builder.addVertexColumn(spec); });
    this->readRecords(element, plan, this->Fan,
      [this, &plan]
      {
        this->Builder.vertex(this->Position[0], this->Position[1], this->Position[2]);
        for (const PlyTuple& tuple : plan.tuples)
        {
          this->Builder.vertexTuples(tuple.column, this->bytesOf(tuple));
        }
      });
  }

  /** `run` converts the corners of a cell to triangles. */
  template <class Run>
  void readCells(const PlyElement& element, Run& run)
  {
    // Attributes would be required for both faces and strips.
    const bool alone = !std::exchange(this->HasCells, true);
    const PlyPlan plan = planOf(element, PlyRole::Cells,
      [this, alone](const ColumnSpec& spec)
      {
        if (!alone)
        {
          this->CellColumns.push_back(-1);
          return -1;
        }
        this->CellColumns.push_back(this->Builder.addElementColumn(spec));
        return this->CellColumns.back();
      });
    if (!alone && !this->CellColumns.empty())
    {
      this->Builder.note("The attributes of the faces are left out, since the file has several "
                         "elements of cells, which do not share them.");
      for (const int column : this->CellColumns)
      {
        this->Builder.dropElementColumn(column);
      }
      this->CellColumns.clear();
    }
    const bool hasCorners =
      std::ranges::any_of(plan.steps, [](auto& step) { return step.kind == PlyStep::Corners; });
    this->readRecords(element, plan, run,
      [this, &plan, hasCorners]
      {
        if (!hasCorners)
        {
          this->Builder.dropped();
        }
        for (const PlyTuple& tuple : plan.tuples)
        {
          this->Builder.elementTuples(tuple.column, this->bytesOf(tuple));
        }
      });
  }

  std::span<const std::byte> bytesOf(const PlyTuple& tuple) const
  {
    return { this->Attributes.data() + tuple.begin, tuple.bytes };
  }

  /** Calls `take` after each record. */
  template <class Run, class Take>
  void readRecords(const PlyElement& element, const PlyPlan& plan, Run& run, Take&& take)
  {
    this->Attributes.resize(plan.attributeBytes);
    for (std::int64_t i = 0; i < element.count; ++i)
    {
      this->In.begin(element.name, i);
      for (const PlyStep& step : plan.steps)
      {
        this->doStep(step, run);
      }
      take();
    }
  }

  template <class Run>
  void doStep(const PlyStep& step, Run& run)
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
        this->In.skip(step.type, this->readLength(step));
        break;
      case PlyStep::Corners:
        dispatch(step.type, [this, length = this->readLength(step), &run]<class T>(T)
          { this->template readCorners<T>(length, run); });
        break;
    }
  }

  std::int64_t readLength(const PlyStep& step)
  {
    const auto length = static_cast<std::int64_t>(this->In.read(step.lengthType));
    if (length < 0 || !this->In.holds(step.type, length))
    {
      this->In.fail(length < 0 ? "a list has a negative length"
                               : "the file is truncated, or the list length " +
                                   std::to_string(length) + " is wrong");
    }
    return length;
  }

  template <class T, class Run>
  void readCorners(std::int64_t length, Run& run)
  {
    constexpr bool strip = std::is_same_v<Run, TriangleStrip>;
    if (!strip && length == 3)
    {
      const std::int64_t a = this->template readCorner<T, strip>();
      const std::int64_t b = this->template readCorner<T, strip>();
      this->Builder.triangle(a, b, this->template readCorner<T, strip>());
      return;
    }
    for (std::int64_t i = 0; i < length; ++i)
    {
      run.corner(this->template readCorner<T, strip>());
    }
    run.end();
  }

  template <class T, bool IsStrip>
  std::int64_t readCorner()
  {
    const T value = this->In.template take<T>();
    if constexpr (std::is_floating_point_v<T>)
    {
      if (!(std::abs(value) < T(9e15)) || value != std::floor(value))
      {
        this->In.fail("a corner is not an integer");
      }
    }
    const auto corner = static_cast<std::int64_t>(value);
    const bool exists = corner >= 0 && corner < this->Vertices;
    if (!exists && !(IsStrip && corner == -1))
    {
      this->In.fail("the corner " + std::to_string(corner) + " is none of the " +
                    std::to_string(this->Vertices) + " vertices");
    }
    return corner;
  }

  const PlyHeader& Header;
  Cursor In;
  RawMeshBuilder& Builder;
  TriangleFan Fan;
  TriangleStrip Strip;
  std::int64_t Vertices = 0;
  bool HasVertices = false, HasCells = false;
  std::vector<int> CellColumns;
  std::array<double, 3> Position{};
  std::vector<std::byte> Attributes; ///< of a record
};

/** Refuses counts that exceed the rest of the file. */
void checkLength(const InputFile& file, const PlyHeader& header)
{
  const bool ascii = header.encoding == PlyEncoding::Ascii;
  // The last number of a text may lack a line end.
  std::uint64_t left = file.size() - header.bodyOffset + (ascii ? 1 : 0);
  for (const PlyElement& element : header.elements)
  {
    const std::size_t least = element.minBytes(ascii);
    if (least > 0 && static_cast<std::uint64_t>(element.count) > left / least)
    {
      throw Error(file.name() + ": the file is truncated: the header promises " +
                  std::to_string(element.count) + " records of element " + inQuotes(element.name) +
                  ", for which the file of " + std::to_string(file.size()) +
                  " bytes is too short.");
    }
    left -= static_cast<std::uint64_t>(element.count) * least;
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
  withPlyBody(file, header, &builder.workspace(),
    [&](auto cursor) { BodyReader(header, std::move(cursor), builder).read(); });
}

} // namespace smg
