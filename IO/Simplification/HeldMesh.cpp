// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/HeldMesh.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Mesh/VisitBlocks.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>
#include <variant>

// What a simplification holds, and its seams, as a column of the stream: so it goes with the
// vertices wherever their other columns go.

namespace smg
{
namespace
{

void append(std::string& text, const char* what, std::span<const double> numbers)
{
  text += what;
  for (const double number : numbers)
  {
    char digits[32];
    // Seventeen digits: different numbers are different texts.
    std::snprintf(digits, sizeof(digits), " %.17g", number);
    text += digits;
  }
  text += ';';
}

void append(std::string& text, const Region::HalfSpace& shape)
{
  append(text, "half-space", shape.normal);
  append(text, "", { &shape.distance, 1 });
}

void append(std::string& text, const Region::Box& shape)
{
  append(text, "box", shape.low);
  append(text, "", shape.high);
}

void append(std::string& text, const Region::Sphere& shape)
{
  append(text, "sphere", shape.center);
  append(text, "", { &shape.radius, 1 });
}

void append(std::string& text, const Region::Vertices& shape)
{
  text += "vertices";
  for (const std::int64_t id : shape.ids)
  {
    text += ' ' + std::to_string(id);
  }
  text += ';';
}

void append(std::string& text, const Region& region)
{
  std::visit([&text](const auto& shape) { append(text, shape); }, region.shape());
}

void append(std::string& text, const Everywhere& /*part*/)
{
  text += "everywhere;";
}

void append(std::string& text, const ColumnTag& part)
{
  append(text, ("tag " + part.column).c_str(), { &part.value, 1 });
}

void append(std::string& text, const ColumnMask& part)
{
  text += "mask " + part.column + ';';
}

void append(std::string& text, const NearestVertices& part)
{
  for (const std::array<double, 3>& point : part.points)
  {
    append(text, "nearest", point);
  }
}

void append(std::string& text, const OnBoundary& /*part*/)
{
  text += "boundary;";
}

void append(std::string& text, const InGroup& part)
{
  text += "group";
  for (const std::string& name : part.names)
  {
    text += ' ' + std::to_string(name.size()) + ' ' + name;
  }
  text += ';';
}

void append(std::string& text, const Combination& part)
{
  text += "combined " + std::to_string(static_cast<int>(part.kind)) + ' ' +
          std::to_string(part.parts.size()) + " (" + textOf(part.parts) + ')';
}

} // namespace

std::string textOf(const std::vector<Where>& parts)
{
  std::string text;
  for (const Where& part : parts)
  {
    std::visit([&text](const auto& each) { append(text, each); }, part);
  }
  return text;
}

HeldMesh::HeldMesh(const StoredMesh& mesh, const std::vector<Where>& parts, std::int64_t memory,
  const std::filesystem::path& scratch, const ProgressFunction& progress)
  : Columns(mesh.info(), "simplify")
  , Vertices(parts, false, this->Columns)
  , Holds(!parts.empty())
{
  this->Columns.memory().setLimit(memory);
  const bool isSurface = mesh.info().cellType == CellType::Triangle;
  if (this->Holds || isSurface)
  {
    constexpr std::int64_t ShareOfSeams = 8;
    SeamVertices seams(this->Columns.memory(), memory / ShareOfSeams);
    visitBlocks(*mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns()), progress,
      0.0, 1.0,
      [&](const MeshBlock& block)
      {
        this->Vertices.prepare(block, scratch);
        if (isSurface)
        {
          seams.add(block);
        }
      });
    this->Vertices.endPreparing(false);
    seams.finish();
    this->SeamPlaces = seams.places();
    if (seams.isExact())
    {
      this->Seams = seams.seams();
    }
  }
  this->Columns.memory().acquire(
    static_cast<std::int64_t>(this->Seams.size() * sizeof(SeamVertices::Seam)));
  this->Marks = this->Holds || !this->Seams.empty();
  this->Mesh =
    mesh.source(columnNames(mesh.info().vertexColumns), columnNames(carriedColumns(mesh.info())));
  if (this->Marks)
  {
    this->Mesh = std::make_unique<AddedColumn>(std::move(this->Mesh), AddedColumn::Vertices,
      ColumnSpec{ "held", ScalarType::UInt8, 1 },
      [this](const MeshBlock& block, Column& column)
      { this->mark(block, column.as<std::uint8_t>()); });
  }
}

void HeldMesh::mark(const MeshBlock& block, std::span<std::uint8_t> marks)
{
  std::ranges::fill(marks, 0);
  const std::int64_t end = block.firstVertex + block.vertices();
  for (auto seam =
         std::ranges::lower_bound(this->Seams, block.firstVertex, {}, &SeamVertices::Seam::vertex);
       seam != this->Seams.end() && seam->vertex < end; ++seam)
  {
    marks[static_cast<std::size_t>(seam->vertex - block.firstVertex)] =
      static_cast<std::uint8_t>(std::min<std::int64_t>(seam->atPlace, SurfacePart::MostOfSeam));
  }
  if (this->Holds)
  {
    const std::span<const std::uint8_t> held = this->Vertices.at(block);
    for (std::size_t v = 0; v < marks.size(); ++v)
    {
      marks[v] = held[v] != 0 ? 1 : marks[v];
    }
    this->Count += static_cast<std::int64_t>(held.size()) - std::ranges::count(held, 0);
  }
}

} // namespace smg
