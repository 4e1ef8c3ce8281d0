// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/OrientedMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

// Streams of a surface that is wound as an Orientation has found.
//
// Of a turned triangle, two corners have changed their places, so that it may use a vertex before
// the one that was introduced first. If it uses at most two vertices for the first time, one of its
// three beginnings has them in order. Of three new vertices, two exchange their numbers; the later
// triangles at these are found by a map, which has such vertices only as long as they are open.

namespace smg
{
namespace
{

/** The sets of groups of the edges of the triangles, each opposite to a corner, which follow the
 * corners; empty: there are none. */
std::span<GroupSet> edgeGroups(MeshBlock& block)
{
  const auto found = std::ranges::find_if(
    block.cellColumns, [](const Column& column) { return column.spec.name == FacetGroupsName; });
  return found == block.cellColumns.end() ? std::span<GroupSet>() : found->as<GroupSet>();
}

/** A stream whose marked triangles are turned. */
class TurnedSource final : public MeshSource
{
public:
  TurnedSource(std::unique_ptr<MeshSource> source, Orientation& orientation)
    : Source(std::move(source))
    , By(orientation)
  {
  }

  const StreamInfo& info() const override { return this->Source->info(); }
  bool next(MeshBlock& block) override
  {
    if (!this->Source->next(block))
    {
      return false;
    }
    this->Marks.resize(block.corners.size() / 3);
    this->By.read(block.firstCell, this->Marks);
    for (std::size_t c = 0; c < this->Marks.size(); ++c)
    {
      if (this->Marks[c] != 0)
      {
        std::swap(block.corners[3 * c + 1], block.corners[3 * c + 2]);
      }
    }
    if (const std::span<GroupSet> edges = edgeGroups(block); !edges.empty())
    {
      for (std::size_t c = 0; c < this->Marks.size(); ++c)
      {
        if (this->Marks[c] != 0)
        {
          std::swap(edges[3 * c + 1], edges[3 * c + 2]);
        }
      }
    }
    return true;
  }

private:
  std::unique_ptr<MeshSource> Source;
  Orientation& By;
  std::vector<std::uint8_t> Marks; ///< of the block
};

class NumberedSource final : public MeshSource
{
public:
  explicit NumberedSource(std::unique_ptr<MeshSource> source)
    : Source(std::move(source))
  {
  }

  const StreamInfo& info() const override { return this->Source->info(); }
  bool next(MeshBlock& block) override
  {
    if (!this->Source->next(block))
    {
      return false;
    }
    this->Edges = edgeGroups(block);
    for (std::size_t c = 0; c < block.corners.size(); c += 3)
    {
      const std::span<std::int64_t, 3> corners(block.corners.data() + c, 3);
      for (std::int64_t& corner : corners)
      {
        const auto exchanged = this->Exchanged.find(corner);
        corner = exchanged == this->Exchanged.end() ? corner : exchanged->second;
      }
      this->putInOrder(block, corners, c);
      this->Used = std::max(this->Used, std::ranges::max(corners) + 1);
    }
    std::erase_if(this->Exchanged,
      [&block](const auto& pair) { return std::max(pair.first, pair.second) < block.finalized; });
    return true;
  }

private:
  /** `first`: the place of the first corner in the block. */
  void putInOrder(MeshBlock& block, std::span<std::int64_t, 3> corners, std::size_t first)
  {
    const auto isInOrder = [corners, this]
    {
      std::int64_t used = this->Used;
      return std::ranges::all_of(corners,
        [&used](std::int64_t corner)
        {
          used += corner == used ? 1 : 0;
          return corner < used;
        });
    };
    for (int k = 0; k < 3; ++k)
    {
      if (isInOrder())
      {
        return;
      }
      std::ranges::rotate(corners, corners.begin() + 1);
      if (!this->Edges.empty())
      {
        const std::span<GroupSet> edges = this->Edges.subspan(first, 3);
        std::ranges::rotate(edges, edges.begin() + 1);
      }
    }
    if (std::min(corners[1], corners[2]) >= block.firstVertex)
    {
      this->exchange(block, corners[1], corners[2]);
    }
  }

  /** Exchanges the numbers of two vertices of the block: in it their rows. */
  void exchange(MeshBlock& block, std::int64_t& a, std::int64_t& b)
  {
    const auto first = static_cast<std::size_t>(a - block.firstVertex);
    const auto second = static_cast<std::size_t>(b - block.firstVertex);
    const auto swapRows = [&](auto* values, std::size_t size) {
      std::swap_ranges(values + size * first, values + size * (first + 1), values + size * second);
    };
    swapRows(block.positions.data(), 3);
    for (Column& column : block.vertexColumns)
    {
      swapRows(
        column.bytes.data(), column.bytes.size() / static_cast<std::size_t>(block.vertices()));
    }
    this->Exchanged[a] = b;
    this->Exchanged[b] = a;
    std::swap(a, b);
  }

  std::unique_ptr<MeshSource> Source;
  std::span<GroupSet> Edges;                      ///< see edgeGroups()
  std::int64_t Used = 0;                          ///< vertices, so far
  std::map<std::int64_t, std::int64_t> Exchanged; ///< numbers of open vertices
};

} // namespace

std::unique_ptr<MeshSource> oriented(std::unique_ptr<MeshSource> source, Orientation& orientation)
{
  return std::make_unique<TurnedSource>(std::move(source), orientation);
}

std::unique_ptr<MeshSource> numberedByFirstUse(std::unique_ptr<MeshSource> turned)
{
  return std::make_unique<NumberedSource>(std::move(turned));
}

std::unique_ptr<MeshSource> OrientedMesh::source(
  std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const
{
  return oriented(this->Mesh.source(std::move(vertexColumns), std::move(cellColumns)), this->By);
}

} // namespace smg
