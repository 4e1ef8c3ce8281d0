// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/HeldMesh.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Mesh/VisitBlocks.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <span>
#include <variant>

// What a simplification holds, as a column of the stream: so it goes with the vertices wherever
// their other columns go.

namespace smg
{
namespace
{

constexpr const char* HeldName = "held";

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
{
  this->Columns.memory().setLimit(memory);
  visitBlocks(*mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns()), progress,
    0.0, 1.0, [&](const MeshBlock& block) { this->Vertices.prepare(block, scratch); });
  this->Vertices.endPreparing(false);
  this->Mesh =
    mesh.source(columnNames(mesh.info().vertexColumns), columnNames(mesh.info().cellColumns));
  this->Info = this->Mesh->info();
  this->Info.vertexColumns.push_back({ HeldName, ScalarType::UInt8, 1 });
}

bool HeldMesh::next(MeshBlock& block)
{
  // The column of the last block is none of the mesh.
  block.vertexColumns.resize(
    std::min(block.vertexColumns.size(), this->Info.vertexColumns.size() - 1));
  if (!this->Mesh->next(block))
  {
    return false;
  }
  const std::span<const std::uint8_t> held = this->Vertices.at(block);
  const auto bytes = std::as_bytes(held);
  block.vertexColumns.push_back(
    { this->Info.vertexColumns.back(), { bytes.begin(), bytes.end() } });
  this->Count += static_cast<std::int64_t>(held.size()) - std::ranges::count(held, 0);
  return true;
}

} // namespace smg
