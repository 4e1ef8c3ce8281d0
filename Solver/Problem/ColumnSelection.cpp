// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ColumnSelection.h"

#include "Solver/Core/Text.h"

#include <algorithm>
#include <cmath>
#include <vector>

// Selection by a column of the vertices or cells: where it has a value (tag), or any value but 0
// (mask).
//
// A cell column selects vertices, too: those of the selected cells. A vertex comes before its cells
// in the stream, so these vertices are found by a reading of the stream beforehand and kept in a
// scratch file, one bit each; in memory are the marks of open vertices only. Later readings take
// the bits in stream order.
//
// If no place has the value that is asked for, the error names the values that there are
// (TagValues).

namespace smg
{
namespace
{

/** The shortest text that stands for the number in its precision. Integers have no exponent, since
 * tags are written like that in meshes. */
std::string textOf(double value, bool isSingle)
{
  // 2^53: from there on a double may stand for several integers.
  constexpr double MaxExact = 9007199254740992.0;
  if (value == std::trunc(value) && std::fabs(value) < MaxExact)
  {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  return isSingle ? shortest(static_cast<float>(value)) : shortest(value);
}

} // namespace

/** The values are only needed for the message of an error, so none are collected once the value has
 * been found. */
void TagValues::add(const Column& column, std::span<const std::uint8_t> selected)
{
  this->Found = this->Found || std::ranges::count(selected, 1) > 0;
  this->IsSingle = column.spec.type == ScalarType::Float32;
  for (std::size_t i = 0; i < selected.size() && !this->Found; ++i)
  {
    this->add(column.value(i, 0));
  }
}

/** Enters a value in the ascending list, unless it is there, or only extends the range if there are
 * too many. */
void TagValues::add(double value)
{
  const auto place = std::ranges::lower_bound(this->Values, value);
  // A bisection per value and a move per new one: the list is short.
  const bool isNew = place == this->Values.end() || *place != value;
  // NaN equals no tag.
  if (!isNew || std::isnan(value))
  {
    return;
  }
  if (this->IsRange)
  {
    // Only the range: a column with a different value in every cell must not fill the memory.
    this->Values.front() = std::min(this->Values.front(), value);
    this->Values.back() = std::max(this->Values.back(), value);
    return;
  }
  this->Values.insert(place, value);
  if (this->Values.size() > Most)
  {
    this->Values = { this->Values.front(), this->Values.back() };
    this->IsRange = true;
  }
}

/** In ascending order; at most ten of them. */
std::string TagValues::text() const
{
  constexpr std::size_t Named = 10;
  const auto name = [this](double value) { return textOf(value, this->IsSingle); };
  if (this->Found || this->Values.empty())
  {
    return {};
  }
  const std::size_t count = this->Values.size();
  if (this->IsRange)
  {
    return ": its values, more than " + std::to_string(Most) + ", are from " +
           name(this->Values.front()) + " to " + name(this->Values.back());
  }
  if (count == 1)
  {
    return ": its only value is " + name(this->Values.front());
  }
  std::string list;
  for (std::size_t i = 0; i < std::min(count, Named); ++i)
  {
    list += (i == 0 ? "" : i + 1 < count ? ", " : " and ") + name(this->Values[i]);
  }
  return count <= Named ? ": its values are " + list
                        : ": the smallest of its " + std::to_string(count) + " values are " + list;
}

void CellSelection::begin()
{
  this->Selection::begin();
  this->Tags = {};
  this->Vertices.reset();
  this->Marks.restart();
  this->Marked = this->Written = 0;
  this->IsPrepared = false;
}

/** Counts cells with selected facets, or that are selected; if vertices are to be selected, marks
 * their corners, and writes the marks of vertices that no later cell uses. */
void CellSelection::add(const MeshBlock& block, const std::filesystem::path& scratch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns.cellType()));
  std::vector<std::uint8_t> selected(block.corners.size() / corners);
  this->atFacets({ block, 0, block.corners }, selected);
  this->Count += std::ranges::count_if(selected, [](std::uint8_t facets) { return facets != 0; });
  if (this->Test.value)
  {
    // Collects what the error would name if no cell is selected in the end.
    std::vector<std::uint8_t> cells(selected.size());
    std::ranges::transform(
      selected, cells.begin(), [](std::uint8_t facets) { return facets != 0 ? 1 : 0; });
    this->Tags.add(this->Test.column.in(block), cells);
  }
  if (this->Place != DataPlace::Vertices)
  {
    return;
  }
  if (!this->Vertices)
  {
    // The folder is known from here on.
    this->Vertices.emplace(scratch);
  }
  this->Marks.append(block.vertices());
  this->Marked += block.vertices();
  for (std::size_t c = 0; c < selected.size(); ++c)
  {
    for (std::size_t k = 0; selected[c] && k < corners; ++k)
    {
      // A facet has all corners of its cell but the opposite one.
      if ((selected[c] & ~(1U << k)) != 0)
      {
        *this->Marks.at(block.corners[c * corners + k]) = 1;
      }
    }
  }
  this->Vertices->append({ this->Marks.at(this->Written), this->Marks.at(block.finalized) });
  this->Written = block.finalized;
  // After append(), which has read them.
  this->Marks.release(this->Written);
}

/** Writes the marks that are left. A part of a mesh finalises no vertex before its end, since other
 * parts may have more of its cells: there, all marks are left and can be joined. */
void CellSelection::endPreparing(MeshParts* parts)
{
  this->Selection::endPreparing(parts);
  if (this->Vertices && !this->IsPrepared)
  {
    const std::span<std::uint8_t> marks{ this->Marks.at(this->Written),
      this->Marks.at(this->Marked) };
    if (parts)
    {
      parts->join(marks);
    }
    this->Vertices->append(marks);
    this->Vertices->finish();
    this->Marks.restart();
    this->IsPrepared = true;
  }
}

/** NaN in a mask says neither yes nor no, which is an error that names the cell. For a tag, it just
 * differs from the value. */
void CellSelection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const std::size_t valid =
    this->Test.apply(this->Test.column.in(cells.block), cells.first, selected);
  if (valid < selected.size())
  {
    this->Columns.fail(this->Key + ".mask",
      "is not a number in " + this->Columns.cellName(cells.block, cells.first + valid));
  }
}

/** All facets of a selected cell, or those that the column selects. */
void CellSelection::atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns.cellType()));
  if (this->selectsFacets())
  {
    std::vector<std::uint8_t> facets(selected.size() * corners);
    this->Test.apply(this->Test.column.in(cells.block), cells.first * corners, facets);
    for (std::size_t c = 0; c < selected.size(); ++c)
    {
      selected[c] = 0;
      for (std::size_t k = 0; k < corners; ++k)
      {
        selected[c] |= static_cast<std::uint8_t>(facets[c * corners + k] << k);
      }
    }
    return;
  }
  this->atCells(cells, selected);
  const auto all = static_cast<std::uint8_t>((1U << corners) - 1U);
  std::ranges::for_each(selected, [all](std::uint8_t& bits) { bits = bits ? all : 0; });
}

void CellSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  // Without a file, cells or facets are selected, and the vertices are not asked for.
  if (this->Vertices)
  {
    this->Vertices->read(block.firstVertex, selected);
  }
}

} // namespace smg
