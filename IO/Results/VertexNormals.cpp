// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/VertexNormals.h"

#include "IO/External/PagedArray.h"
#include "IO/Results/CellNormals.h"
#include "IO/Results/NormalSums.h"
#include "Solver/Core/Progress.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

namespace smg
{

namespace
{

/** Sums the normals at the vertices that are not final. */
class OpenSums
{
public:
  OpenSums(const StreamInfo& info, const std::filesystem::path& scratch, std::int64_t memory)
    : Flags(findColumn(info.cellColumns, { CellFlagsName, ScalarType::UInt8, 1 }))
    , Shapes(scratch, memory / 2)
    , Sums(scratch, memory / 2)
  {
  }

  void take(const MeshBlock& block)
  {
    this->Shapes.take(block);
    for (std::size_t cell = 0; cell < block.corners.size() / 3; ++cell)
    {
      if (this->Flags < 0 || block.cellColumns[this->Flags].as<std::uint8_t>()[cell] == 0)
      {
        this->addCell(block, cell);
      }
    }
    this->Shapes.release(block);
    this->Vertices = block.firstVertex + block.vertices();
  }

  std::int64_t vertices() const { return this->Vertices; }

  /** Returns the normals of the vertices [first, end) and releases them. */
  void give(std::int64_t first, std::int64_t end, std::vector<float>& normals)
  {
    normals.clear();
    for (std::int64_t v = first; v < end; ++v)
    {
      const std::array<double, 4> sum = this->Sums.get(v);
      const std::array<float, 3> normal = unitNormal(std::span(sum).first<3>());
      normals.insert(normals.end(), normal.begin(), normal.end());
    }
    this->Sums.discardBelow(end);
  }

private:
  void addCell(const MeshBlock& block, std::size_t cell)
  {
    const TriangleShape shape = this->Shapes.shape(block, cell);
    for (std::size_t k = 0; k < 3; ++k)
    {
      addNormal(shape, k, std::span(this->Sums.at(block.corners[3 * cell + k])).first<3>());
    }
  }

  int Flags;
  CellNormals Shapes;
  PagedArray<std::array<double, 4>> Sums; ///< three numbers per vertex, by stream index
  std::int64_t Vertices = 0;              ///< so far
};

constexpr std::int64_t BytesPerVertex = 3 * sizeof(float);

} // namespace

VertexNormals::VertexNormals(MeshSource& mesh, const NormalsOptions& options)
{
  const StreamInfo& info = mesh.info();
  if (info.cellType != CellType::Triangle)
  {
    throw Error("Normals are those of triangles, but the mesh has tetrahedra: leave them out.");
  }
  const ScratchFolder scratch(options.scratch);
  this->File.create(scratch.path());
  OpenSums sums(info, scratch.path(), options.memory);
  Progress reported(options.progress);
  std::vector<float> normals;
  const auto write = [&](std::int64_t end)
  {
    sums.give(this->Vertices, end, normals);
    this->File.append(std::as_bytes(std::span(normals)));
    this->Vertices = end;
  };
  for (MeshBlock block; mesh.next(block);)
  {
    sums.take(block);
    write(std::max(this->Vertices, block.finalized));
    if (info.cells > 0)
    {
      reported.update(static_cast<double>(block.firstCell) / static_cast<double>(info.cells));
    }
  }
  write(sums.vertices());
  reported.update(1.0);
}

void VertexNormals::read(std::int64_t first, std::int64_t count, std::span<float> normals) const
{
  assert(first >= 0 && first + count <= this->Vertices);
  this->File.read(first * BytesPerVertex,
    std::as_writable_bytes(normals.first(static_cast<std::size_t>(3 * count))));
}

} // namespace smg
