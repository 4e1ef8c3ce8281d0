// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/GhostCells.h"

#include "IO/Formats/Vsm/PieceReader.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace smg
{

GhostCells::GhostCells(VsmFile& file, LastCellReader& lastCells, const PieceCells& piece,
  std::vector<std::int64_t> vertices, int levels)
  : File(file)
  , LastCells(lastCells)
  , Piece(piece)
  , CornersOfCell(static_cast<std::size_t>(cornersOf(file.Info.cellType)))
{
  for (int level = 0; level < levels && !vertices.empty(); ++level)
  {
    vertices = this->addLayer(vertices);
  }
}

/** The blocks of cells outside the piece that may use one of the vertices. */
std::vector<std::int64_t> GhostCells::blocksWith(const std::vector<std::int64_t>& vertices)
{
  std::vector<std::int64_t> last(vertices.size());
  this->LastCells.gather(vertices, last.data());
  const BlockFileReader& blocks = this->File.Blocks;
  // How many ranges of blocks begin at a block, less those that end before it.
  std::vector<std::int64_t> change(static_cast<std::size_t>(this->File.cellBlocks()) + 1);
  const auto add = [&](std::int64_t first, std::int64_t end)
  {
    if (first < end)
    {
      ++change[static_cast<std::size_t>(blocks.blockOf(VsmFormat::Cells, first))];
      --change[static_cast<std::size_t>(blocks.blockOf(VsmFormat::Cells, end - 1)) + 1];
    }
  };
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const std::int64_t end = last[i] + 1;
    const std::int64_t begin =
      vertices[i] >= this->Piece.firstVertex
        ? this->Piece.first
        : blocks.firstRow(VsmFormat::Cells, this->File.blockIntroducing(vertices[i]));
    add(begin, std::min(end, this->Piece.first));
    add(std::max(begin, this->Piece.end), end);
  }
  std::vector<std::int64_t> found;
  std::int64_t ranges = 0;
  for (std::size_t block = 0; block + 1 < change.size(); ++block)
  {
    ranges += change[block];
    if (ranges > 0)
    {
      found.push_back(static_cast<std::int64_t>(block));
    }
  }
  return found;
}

std::vector<std::int64_t> GhostCells::addLayer(const std::vector<std::int64_t>& vertices)
{
  const std::size_t before = this->Cells.size();
  std::vector<std::int64_t> corners;
  const auto isOfLayer = [&](std::span<const std::int64_t> cell)
  {
    return std::ranges::any_of(cell,
      [&vertices](std::int64_t vertex)
      {
        return vertex >= vertices.front() && vertex <= vertices.back() &&
               std::ranges::binary_search(vertices, vertex);
      });
  };
  const auto isKnown = [&](std::int64_t cell)
  {
    return (cell >= this->Piece.first && cell < this->Piece.end) ||
           std::binary_search(
             this->Cells.begin(), this->Cells.begin() + static_cast<std::ptrdiff_t>(before), cell);
  };
  for (const std::int64_t block : this->blocksWith(vertices))
  {
    this->File.readCorners(block, corners);
    std::int64_t cell = this->File.Blocks.firstRow(VsmFormat::Cells, block);
    for (std::size_t at = 0; at < corners.size(); at += this->CornersOfCell, ++cell)
    {
      const auto own = std::span(corners).subspan(at, this->CornersOfCell);
      if (isOfLayer(own) && !isKnown(cell))
      {
        this->Cells.push_back(cell);
        this->Corners.insert(this->Corners.end(), own.begin(), own.end());
      }
    }
  }
  std::vector<std::int64_t> others(
    this->Corners.begin() + static_cast<std::ptrdiff_t>(before * this->CornersOfCell),
    this->Corners.end());
  std::ranges::sort(others);
  others.erase(std::unique(others.begin(), others.end()), others.end());
  std::erase_if(others,
    [&vertices](std::int64_t vertex) { return std::ranges::binary_search(vertices, vertex); });
  this->sortCells();
  return others;
}

void GhostCells::sortCells()
{
  std::vector<std::size_t> order(this->Cells.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::sort(order, {}, [this](std::size_t k) { return this->Cells[k]; });
  std::vector<std::int64_t> cells, corners;
  cells.reserve(this->Cells.size());
  corners.reserve(this->Corners.size());
  for (const std::size_t k : order)
  {
    cells.push_back(this->Cells[k]);
    const auto own = std::span(this->Corners).subspan(k * this->CornersOfCell, this->CornersOfCell);
    corners.insert(corners.end(), own.begin(), own.end());
  }
  this->Cells = std::move(cells);
  this->Corners = std::move(corners);
}

} // namespace smg
