// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Mesh/StreamCheck.h"

#include "Solver/Mesh/VisitCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

// Checks of mesh streams, block by block. Everything behind a stream relies on what is checked
// here: windows release a vertex when it is final, so a later cell that uses it would read memory
// that holds another vertex. Only three numbers are remembered, so the check costs a comparison per
// coordinate and corner and no memory.

namespace smg
{

void StreamCheck::add(const MeshBlock& block)
{
  if (block.positions.size() % 3 != 0 ||
      block.corners.size() % static_cast<std::size_t>(cornersOf(this->Type)) != 0)
  {
    throw Error("the mesh stream is not valid: the block that begins with vertex " +
                std::to_string(block.firstVertex) +
                " ends in the middle of a position or of a cell");
  }
  if (block.firstVertex != this->Vertices || block.firstCell != this->Cells)
  {
    throw Error("the mesh stream is not valid: a block begins with vertex " +
                std::to_string(block.firstVertex) + " and cell " + std::to_string(block.firstCell) +
                ", expected " + std::to_string(this->Vertices) + " and " +
                std::to_string(this->Cells));
  }
  if (const Column* flags = block.flags())
  {
    const auto cells = cellsOf(this->Type, block);
    if (flags->spec.type != ScalarType::UInt8 || flags->spec.components != 1 ||
        flags->bytes.size() != cells)
    {
      throw Error(std::string("the mesh stream is not valid: the column ") + CellFlagsName +
                  " of the block that begins with cell " + std::to_string(block.firstCell) +
                  " must have one number of type uint8 for each cell");
    }
  }
  // Vertices come before the cells of their block, which may use them; what the block declares
  // final comes last, since its own cells may still use that.
  this->addVertices(block);
  this->addCells(block);
  if (block.finalized > this->Vertices)
  {
    throw Error("the mesh stream is not valid: a block declares " +
                std::to_string(block.finalized) + " vertices final but only " +
                std::to_string(this->Vertices) + " have been read");
  }
  // What was declared final stays final: windows have released it.
  if (block.finalized < this->Final)
  {
    throw Error("the mesh stream is not valid: a block declares " +
                std::to_string(block.finalized) + " vertices final, an earlier one " +
                std::to_string(this->Final) + " (`finalized` does not decrease)");
  }
  this->Final = block.finalized;
}

void StreamCheck::addVertices(const MeshBlock& block)
{
  // A single coordinate that is not finite would spread to all values of its component.
  const auto bad = std::find_if(block.positions.begin(), block.positions.end(),
    [](double coordinate) { return !std::isfinite(coordinate); });
  if (bad != block.positions.end())
  {
    throw Error("the position of vertex " +
                std::to_string(this->Vertices + (bad - block.positions.begin()) / 3) +
                " is not a finite number");
  }
  this->Vertices += block.vertices();
}

/** A cell may use vertices that have been read and are not final. It may repeat a corner: whether a
 * cell is degenerate is not a question of the stream. */
void StreamCheck::addCells(const MeshBlock& block)
{
  const auto bad = std::find_if(block.corners.begin(), block.corners.end(),
    [this](std::int64_t corner) { return corner < this->Final || corner >= this->Vertices; });
  const auto corners = static_cast<std::int64_t>(cornersOf(this->Type));
  if (bad != block.corners.end())
  {
    throw Error("the mesh stream is not valid: cell " +
                std::to_string(this->Cells + (bad - block.corners.begin()) / corners) +
                " uses vertex " + std::to_string(*bad) + ", which " +
                (*bad >= this->Vertices ? "is not defined yet" : "was declared final"));
  }
  this->Cells += static_cast<std::int64_t>(block.corners.size()) / corners;
}

/** A stream that ends early was cut off, and lacks vertices or cells of the mesh. Counts that are
 * not known are 0 or less, and nothing is required of them. */
void StreamCheck::finish(const StreamInfo& info) const
{
  if (this->Vertices < info.vertices || this->Cells < info.cells)
  {
    throw Error("the mesh stream ends early: after " + std::to_string(this->Vertices) +
                " vertices and " + std::to_string(this->Cells) + " cells, but it states " +
                std::to_string(info.vertices) + " and " + std::to_string(info.cells) +
                " (0 or less: not known)");
  }
}

std::string unweldedNote(CellType type, std::int64_t vertices, std::int64_t cells)
{
  constexpr std::int64_t Few = 100;
  const bool isSurface = type == CellType::Triangle;
  // With b bodies, vertices <= cells + 2 b (tetrahedra: cells + 3 b), see the header: so there are
  // at least as many bodies as this.
  const std::int64_t bodies = (vertices - cells) / (isSurface ? 2 : 3);
  if (cells < Few || bodies < cells / 2)
  {
    return {};
  }
  return std::string("Most ") + (isSurface ? "triangles" : "tetrahedra") +
         " of the mesh share no " + (isSurface ? "edge" : "face") +
         " with another: " + std::to_string(vertices) + " vertices of " + std::to_string(cells) +
         " cells. If points that lie together are one point, merge those of equal coordinates, or "
         "within a distance, first " +
         HowToWeld;
}

void noteUnwelded(CellType type, std::int64_t vertices, std::int64_t cells, Report& report)
{
  if (std::string note = unweldedNote(type, vertices, cells); !note.empty())
  {
    report.notes.push_back(std::move(note));
  }
}

} // namespace smg
