// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/Selection.h"
#include "smg/Column.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace smg
{

/** Tests a column for a value, for values other than 0, or for sets of groups. The column has one
 * component, or one for each facet of a cell. */
struct ColumnTest
{
  NamedColumn column;
  std::optional<double> value; ///< none: any value other than 0
  /** For each set 1 if it has one of the groups that are asked for; empty: no groups are. */
  std::vector<std::uint8_t> sets = {};
  std::string groups = {}; ///< their names, for messages

  /** Sets `selected` to 1 where the numbers of `values` from `first` on are as asked for, else to
   * 0. Returns the index of the first NaN in a mask, or the size of `selected`. */
  std::size_t apply(const Column& values, std::size_t first, std::span<std::uint8_t> selected) const
  {
    std::size_t valid = selected.size();
    if (!this->sets.empty())
    {
      const std::span<const GroupSet> numbers = values.as<GroupSet>().subspan(first);
      for (std::size_t i = 0; i < selected.size(); ++i)
      {
        selected[i] = numbers[i] < this->sets.size() ? this->sets[numbers[i]] : 0;
      }
      return valid;
    }
    dispatch(values.spec.type,
      [&]<class T>(T)
      {
        const std::span<const T> numbers = values.as<T>().subspan(first);
        for (std::size_t i = 0; i < selected.size(); ++i)
        {
          const auto number = static_cast<double>(numbers[i]);
          selected[i] = (this->value ? number == this->valueAs<T>() : number != 0.0) ? 1 : 0;
          valid = !this->value && std::isnan(number) ? std::min(valid, i) : valid;
        }
      });
    return valid;
  }

  /** The value in the precision of T: 0.1 in single precision is another number. */
  template <class T>
  double valueAs() const
  {
    return std::is_same_v<T, float> ? static_cast<double>(static_cast<float>(*this->value))
                                    : *this->value;
  }

  /** The predicate of a selected item, for messages. */
  std::string predicate() const
  {
    if (!this->sets.empty())
    {
      return "is in " + this->groups;
    }
    return (this->value ? "has this tag in '" : "has a value other than 0 in '") +
           this->column.name + "'";
  }
};

/** The different values of a column, collected until the value that is sought turns up. If it never
 * does, the error message names them. */
class TagValues
{
public:
  /** Adds a part of the column, where `selected` is 1 at the value that is sought. */
  void add(const Column& column, std::span<const std::uint8_t> selected);

  /** For example ": its values are 1, 2 and 5". Of more than 10 values it names the smallest 10, of
   * more than 1000 only the range. Empty if the value was found, or the column has no values. */
  std::string text() const;

private:
  static constexpr std::size_t Most = 1000;

  void add(double value);

  bool Found = false;
  std::vector<double> Values; ///< ascending; if there are more than Most, the first and the last
  bool IsRange = false;       ///< whether there are more than Most
  bool IsSingle = false;      ///< whether the column has single precision
};

/** The selection by a column of the vertices. */
class ColumnSelection : public Selection
{
public:
  ColumnSelection(
    ColumnTest test, DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
    , Test(std::move(test))
  {
  }

protected:
  void begin() override
  {
    this->Selection::begin();
    this->Tags = {};
  }
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override
  {
    this->Selection::add(block, scratch);
    this->Tags.add(this->Test.column.in(block), this->atVertices());
  }
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override
  {
    const std::size_t valid = this->Test.apply(this->Test.column.in(block), 0, selected);
    if (valid < selected.size())
    {
      this->Columns.fail(
        this->Key + ".mask", "is not a number at " + this->Columns.vertexName(block, valid));
    }
  }
  std::string predicate() const override { return this->Test.predicate(); }
  std::string instead() const override { return this->Test.value ? this->Tags.text() : ""; }

private:
  ColumnTest Test;
  TagValues Tags; ///< during preparation
};

/** The selection by a column of the cells: cells, their vertices and their facets; or, by a column
 * with a component for each facet, facets and their corners. Vertices precede their cells in a
 * stream, so that the selected ones are found by a reading beforehand. */
class CellSelection : public Selection
{
public:
  CellSelection(
    ColumnTest test, DataPlace place, const std::string& key, const MeshColumns& columns)
    : Selection(place, key, columns)
    , Test(std::move(test))
    , Marks(columns.memory())
  {
  }

  bool needsPreparing() const override
  {
    return this->Place == DataPlace::Vertices && !this->IsPrepared;
  }
  void endPreparing(MeshParts* parts) override;
  VertexSetFile* preparedVertices() override { return this->Vertices ? &*this->Vertices : nullptr; }

  void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override;
  void atInnerFacets(const CellRange& cells, std::span<std::uint8_t> selected) const override
  {
    this->selectsFacets() ? this->atFacets(cells, selected)
                          : this->Selection::atInnerFacets(cells, selected);
  }

protected:
  void begin() override;
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override
  {
    return (this->Place == DataPlace::Cells ? ""
             : this->selectsFacets()        ? "is of a facet that "
                                            : "is of a cell that ") +
           this->Test.predicate();
  }
  std::string instead() const override { return this->Test.value ? this->Tags.text() : ""; }

private:
  bool selectsFacets() const { return this->Test.column.components > 1; }

  ColumnTest Test;
  TagValues Tags;                        ///< during preparation
  std::optional<VertexSetFile> Vertices; ///< of the selected cells, if requested
  OpenValues<std::uint8_t> Marks;        ///< of open vertices, during preparation
  std::int64_t Marked = 0, Written = 0;  ///< vertices read, and written to the file
  bool IsPrepared = false;               ///< whether the file has all vertices
};

} // namespace smg
