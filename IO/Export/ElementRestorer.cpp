// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/ElementRestorer.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Memory/Reservation.h"

#include <algorithm>
#include <cstring>

namespace smg
{

namespace
{

/** The approximate bytes per triangle of the search for a polygon. */
constexpr std::size_t BytesOfFanTriangle = 64;

constexpr std::int64_t ChunkElements = 8192;
constexpr std::size_t ChunkCorners = std::size_t(64) << 10;
/** The approximate bytes of columns delivered at once. */
constexpr std::size_t ElementChunkBytes = std::size_t(512) << 10;

/** The memory for an element that is processed as a whole. */
std::int64_t elementBytes(Workspace& workspace)
{
  return workspace.pool().limit() / 8;
}

} // namespace

ElementRestorer::ElementRestorer(
  Workspace& workspace, std::int64_t memory, const RestoredInfo& info)
  : Space(workspace)
  , CornersOfCell(static_cast<std::size_t>(cornersOf(info.cellType)))
  , Columns(info.elementColumns)
  , Sorted(workspace, memory, this->CornersOfCell * sizeof(std::uint32_t) + this->Columns.bytes())
  , Elements(workspace)
  , MostCells(static_cast<std::size_t>(elementBytes(workspace)) /
              (BytesOfFanTriangle + this->Columns.bytes()))
{
}

void ElementRestorer::put(std::int64_t element, std::span<const std::uint32_t> corners,
  const std::vector<Column>& columns, std::size_t tuple)
{
  std::byte* const row = this->Sorted.put(static_cast<std::uint64_t>(element));
  std::memcpy(row, corners.data(), corners.size_bytes());
  this->Columns.gather(columns, tuple, row + corners.size_bytes());
}

void ElementRestorer::restore(RestoredInfo& info)
{
  this->Sorted.sort();
  const Reservation reserved(this->Space.pool(), elementBytes(this->Space));
  for (RowSort::Row row; this->Sorted.next(row);)
  {
    this->take(row);
  }
  this->endGroup();
  this->Elements.close();
  info.elements = this->Counts.elements;
  info.quadrilaterals = this->Counts.quadrilaterals;
  info.corners = this->Counts.corners;
  info.mostCorners = this->Counts.mostCorners;
}

void ElementRestorer::take(const RowSort::Row& row)
{
  if (row.key != this->Element)
  {
    this->endGroup();
    this->Element = row.key;
    this->TooLarge = false;
    this->MayBeFan = this->CornersOfCell == 3;
    std::memcpy(&this->Apex, row.bytes, sizeof(this->Apex));
  }
  if (this->Corners.size() == this->MostCells * this->CornersOfCell)
  {
    // The cells of such a large element are delivered one by one.
    this->TooLarge = true;
    this->writeCells();
  }
  const std::size_t size = this->Corners.size();
  this->Corners.resize(size + this->CornersOfCell);
  const std::size_t cornerBytes = this->CornersOfCell * sizeof(std::uint32_t);
  std::memcpy(&this->Corners[size], row.bytes, cornerBytes);
  this->MayBeFan = this->MayBeFan && this->Corners[size] == this->Apex;
  const std::byte* const tuples = row.bytes + cornerBytes;
  this->Tuples.insert(this->Tuples.end(), tuples, tuples + this->Columns.bytes());
}

/** Writes the last collected cells of one element, as a polygon if they are its fan. */
void ElementRestorer::endGroup()
{
  const bool isOne = this->Corners.size() <= this->CornersOfCell && !this->TooLarge;
  if (!isOne && this->MayBeFan && !this->TooLarge && this->Fan.build(this->Corners))
  {
    const std::span<const std::byte> tuples = this->Tuples;
    const std::size_t bytes = this->Columns.bytes();
    // All tuples are equal if each equals the one before.
    const bool same =
      std::equal(tuples.begin() + static_cast<std::ptrdiff_t>(bytes), tuples.end(), tuples.begin());
    this->Different += same ? 0 : 1;
    this->write(this->Fan.polygon(), tuples.first(bytes));
    this->Corners.clear();
    this->Tuples.clear();
    return;
  }
  // More memory would only help a polygon.
  this->Large += this->TooLarge && this->MayBeFan ? 1 : 0;
  this->Split += isOne || (this->TooLarge && this->MayBeFan) ? 0 : 1;
  this->writeCells();
}

/** Writes the collected cells as they are. */
void ElementRestorer::writeCells()
{
  const std::size_t bytes = this->Columns.bytes();
  for (std::size_t cell = 0; cell < this->Corners.size() / this->CornersOfCell; ++cell)
  {
    this->write(std::span(this->Corners).subspan(cell * this->CornersOfCell, this->CornersOfCell),
      std::span(this->Tuples).subspan(cell * bytes, bytes));
  }
  this->Corners.clear();
  this->Tuples.clear();
}

void ElementRestorer::write(
  std::span<const std::uint32_t> corners, std::span<const std::byte> tuples)
{
  const auto size = static_cast<std::uint32_t>(corners.size());
  this->Elements.put(0, size);
  this->Elements.append(0, std::as_bytes(corners));
  this->Elements.append(0, tuples);
  ++this->Counts.elements;
  this->Counts.quadrilaterals += size == 4 && this->CornersOfCell == 3 ? 1 : 0;
  this->Counts.corners += size;
  this->Counts.mostCorners = std::max<std::int64_t>(this->Counts.mostCorners, size);
}

std::vector<std::string> ElementRestorer::notes() const
{
  std::vector<std::string> notes;
  const std::string cells = this->CornersOfCell == 3 ? "triangles" : "tetrahedra";
  if (this->Split > 0)
  {
    notes.push_back(
      std::to_string(this->Split) +
      (this->Split == 1
          ? " cell of the original file, which became several " + cells + ", is"
          : " cells of the original file, which became several " + cells + " each, are") +
      " written as these " + cells + ".");
  }
  if (this->Large > 0)
  {
    notes.push_back(
      std::to_string(this->Large) +
      (this->Large == 1 ? " polygon of more than " : " polygons of more than ") +
      std::to_string(this->MostCells) +
      (this->Large == 1 ? " corners is written as triangles: allow more memory to keep it."
                        : " corners are written as triangles: allow more memory to keep them."));
  }
  if (this->Different > 0)
  {
    notes.push_back(std::to_string(this->Different) +
                    " polygons were triangles with different values in the mesh stream: they have "
                    "those of one of these.");
  }
  return notes;
}

bool ElementRestorer::next(RestoredElements& elements)
{
  if (!this->Reader)
  {
    this->Reader.emplace(this->Elements);
    this->Next = 0;
  }
  elements.first = this->Next;
  elements.sizes.clear();
  elements.corners.clear();
  elements.columns = emptyColumns(this->Columns.specs());
  std::vector<std::byte> tuples(this->Columns.bytes());
  std::vector<std::uint32_t> corners;
  const std::int64_t most = std::clamp<std::int64_t>(
    static_cast<std::int64_t>(ElementChunkBytes / (1 + this->Columns.bytes())), 1, ChunkElements);
  std::uint32_t size = 0;
  while (
    elements.count() < most && elements.corners.size() < ChunkCorners && this->Reader->get(size))
  {
    corners.resize(size);
    this->Reader->read(std::as_writable_bytes(std::span(corners)));
    this->Reader->read(tuples);
    elements.sizes.push_back(size);
    elements.corners.insert(elements.corners.end(), corners.begin(), corners.end());
    this->Columns.append(tuples.data(), elements.columns);
  }
  this->Next += elements.count();
  return elements.count() > 0;
}

} // namespace smg
