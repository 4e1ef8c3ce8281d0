// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Motion/MovedVertices.h"

#include "IO/Formats/Vsm/AttributeNames.h"
#include "Solver/Stream/OriginalNumbers.h"
#include "smg/Error.h"

#include <algorithm>

namespace smg
{

namespace
{

/** Vertices whose values are read at once. */
constexpr std::int64_t ReadVertices = 4096;

std::ptrdiff_t requireIds(const StreamInfo& info)
{
  const std::ptrdiff_t ids =
    findColumn(info.vertexColumns, { OriginalIdName, ScalarType::Int64, 1 });
  if (ids < 0)
  {
    throw Error(std::string("The mesh has no column ") + OriginalIdName +
                ", which says where its vertices stand in the file that it was made of.");
  }
  return ids;
}

std::ptrdiff_t findNormals(const StreamInfo& info)
{
  const auto found = std::ranges::find_if(info.vertexColumns, isNormals);
  return found == info.vertexColumns.end() ? -1 : found - info.vertexColumns.begin();
}

} // namespace

MovedVertices::MovedVertices(MeshSource& moved, const std::filesystem::path& scratch,
  std::int64_t memory, const ProgressFunction& progress)
  : Ids(requireIds(moved.info()))
  , Normals(findNormals(moved.info()))
  , Order(this->numbers() * sizeof(double), scratch, memory)
{
  Progress reported(progress);
  std::int64_t vertices = 0;
  for (MeshBlock block; moved.next(block);)
  {
    this->put(block);
    vertices += block.vertices();
    reported.update(static_cast<double>(vertices) /
                    static_cast<double>(std::max(moved.info().vertices, vertices)));
  }
}

void MovedVertices::put(const MeshBlock& block)
{
  const std::vector<double>* values = &block.positions;
  if (this->hasNormals())
  {
    const Column& normals = block.vertexColumns[static_cast<std::size_t>(this->Normals)];
    this->Values.clear();
    for (std::size_t v = 0; v < normals.tuples(); ++v)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        this->Values.push_back(block.positions[3 * v + axis]);
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Values.push_back(normals.value(v, axis));
      }
    }
    values = &this->Values;
  }
  this->Order.put(block.vertexColumns[static_cast<std::size_t>(this->Ids)].as<std::int64_t>(),
    std::as_bytes(std::span(*values)));
}

void MovedVertices::check(std::int64_t vertices, const std::string& name) const
{
  if (this->Order.end() > vertices)
  {
    throw Error(name + ": the mesh has a vertex " + std::to_string(this->Order.end() - 1) +
                ", but the file only " + std::to_string(vertices) +
                " vertices: it is not the one that the mesh was made of.");
  }
}

bool MovedVertices::find(std::int64_t vertex)
{
  if (vertex < this->First || vertex >= this->First + static_cast<std::int64_t>(this->Given.size()))
  {
    this->First = vertex;
    this->Given.resize(ReadVertices);
    this->Values.resize(ReadVertices * this->numbers());
    this->Order.read(vertex, this->Given, std::as_writable_bytes(std::span(this->Values)));
  }
  const auto place = static_cast<std::size_t>(vertex - this->First);
  this->Found =
    std::span<const double>(this->Values).subspan(place * this->numbers(), this->numbers());
  return this->Given[place] != 0;
}

} // namespace smg
