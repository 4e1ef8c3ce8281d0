// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/WallTriangles.h"

#include "Solver/Assembly/CellFacets.h"
#include "Solver/Assembly/FlatCells.h"

#include <algorithm>

namespace smg
{

WallTriangles::WallTriangles(ScratchBlocks& to, DistanceSources& from, bool everywhere, Pool& pool)
  : To(to)
  , From(from)
  , Everywhere(everywhere)
  , Open(pool)
  , Points(pool, 3)
  , Numbers(pool)
{
  this->Block.reserve(BlockTriangles);
}

void WallTriangles::add(const MeshBlock& block)
{
  this->addVertices(block);
  this->addCells(block);
  this->take(block.finalized);
}

void WallTriangles::addVertices(const MeshBlock& block)
{
  this->Vertices = block.firstVertex + block.vertices();
  this->Open.extend(this->Vertices);
  this->Points.extendRaw(this->Vertices);
  this->Numbers.extendRaw(this->Vertices);
  std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
  for (std::int64_t i = 0; i < block.vertices(); ++i)
  {
    this->Numbers[block.firstVertex + i] = this->From.numberOf(block, static_cast<std::size_t>(i));
  }
}

void WallTriangles::addCells(const MeshBlock& block)
{
  constexpr int Corners = 4;
  const Column* flags = block.flags();
  const std::span<const std::uint8_t> selected = this->From.facetsAt(block);
  for (std::size_t c = 0; c < block.corners.size() / Corners; ++c)
  {
    const std::int64_t* corner = block.corners.data() + c * Corners;
    const unsigned flag = flags ? flags->as<std::uint8_t>()[c] : 0U;
    if (!isDistinctCell(corner, Corners, flag))
    {
      continue;
    }
    for (int k = 0; k < Corners; ++k)
    {
      const CellFacet facet = facetOf(CellType::Tetrahedron, corner, k);
      const std::int32_t isWall = this->Everywhere || (selected[c] >> k & 1U) != 0 ? 1 : 0;
      this->Open.add(facet.vertex[0], facet.vertex[1], facet.vertex[2], isWall);
    }
  }
}

void WallTriangles::take(std::int64_t end)
{
  for (; this->Final < end; ++this->Final)
  {
    this->Open.take(this->Final,
      [&](std::int64_t middle, std::int64_t high, std::int32_t isWall)
      {
        if (isWall == 0)
        {
          return;
        }
        WallTriangle& triangle = this->Block.emplace_back();
        const std::int64_t corners[3] = { this->Final, middle, high };
        for (int k = 0; k < 3; ++k)
        {
          std::copy_n(this->Points.at(corners[k]), 3, triangle.points.point[k]);
          triangle.numbers[k] = this->Numbers[corners[k]];
        }
        if (this->Block.size() == BlockTriangles)
        {
          this->writeBlock();
        }
      });
  }
  this->Open.release(this->Final);
  this->Points.release(this->Final);
  this->Numbers.release(this->Final);
}

void WallTriangles::writeBlock()
{
  this->To.write(this->Count / BlockTriangles, std::as_bytes(std::span(this->Block)));
  this->Count += static_cast<std::int64_t>(this->Block.size());
  this->Block.clear();
}

void WallTriangles::finish()
{
  this->take(this->Vertices);
  if (!this->Block.empty())
  {
    this->writeBlock();
  }
}

} // namespace smg
