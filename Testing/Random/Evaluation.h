// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace smg::testing
{

/** What places and values refer to. */
enum class Of
{
  Vertices,
  Cells,
  Facets
};

/** A facet of a cell: opposite to its corner k. */
struct Facet
{
  std::int64_t cell;
  std::vector<std::int64_t> corners; ///< ascending
};

/** The column of this name; null: there is none. */
const CaseColumn* find(const std::vector<CaseColumn>& columns, const std::string& name);
/** A row of a column. */
Eigen::VectorXd rowOf(const CaseColumn& column, std::int64_t row);
/** The entries of a datum: a list of objects, or one value that holds everywhere. */
std::vector<nlohmann::json> entriesOf(const nlohmann::json& datum);

/** Evaluates places and values on a mesh. */
class Evaluation
{
public:
  explicit Evaluation(const Case& given);

  const std::vector<std::uint8_t>& flags() const { return this->Flags; }
  const std::vector<Facet>& facets() const { return this->All; }
  const std::vector<std::size_t>& boundary() const { return this->Boundary; }
  Eigen::Vector3d point(std::int64_t v) const
  {
    return Eigen::Vector3d::Map(&this->On.points[3 * static_cast<std::size_t>(v)]);
  }

  /** The vertices, cells or facets of a place, or of a part of one; sets `isEmpty` if there are
   * none. */
  std::vector<bool> select(
    const nlohmann::json& place, Of of, bool& isEmpty, bool isPart = false) const;
  /** For each vertex, cell or facet the last entry that holds there; -1: none. */
  std::vector<int> last(const std::vector<nlohmann::json>& entries, Of of, bool& isEmpty) const;

  Eigen::VectorXd atVertex(const nlohmann::json& value, std::int64_t v) const;
  Eigen::VectorXd inCell(const nlohmann::json& value, std::int64_t c) const;
  /** At the corner v of cell c. */
  Eigen::VectorXd atCorner(const nlohmann::json& value, std::int64_t c, std::int64_t v) const
  {
    const CaseColumn* ofCells = this->cellColumn(value);
    return ofCells ? rowOf(*ofCells, c) : this->atVertex(value, v);
  }
  const CaseColumn* cellColumn(const nlohmann::json& value) const
  {
    return value.is_string() ? find(this->On.cellColumns, value) : nullptr;
  }
  /** Whether an entry names a column or a group of the cells. */
  bool namesCells(const nlohmann::json& entry) const
  {
    return this->cellColumn(entry.at("value")) || this->isOfCells(entry);
  }

  /** The facets of cells that lie between cells. */
  const std::vector<std::size_t>& inner() const { return this->Inner; }
  /** For each facet between cells the last entry that is stated for facets and holds there. */
  std::vector<int> lastInside(const std::vector<nlohmann::json>& entries) const;
  /** The cells of a group, by its number in Case::groups. */
  std::vector<bool> cellsOf(std::size_t group) const;

  /** The boundary facets in any of these places, and those between cells that these are stated for;
   * of no place, all of the boundary. */
  std::vector<std::size_t> walls(const nlohmann::json& places) const;

private:
  bool isOfCells(const nlohmann::json& place) const;
  std::vector<bool> inside(const nlohmann::json& place) const;
  /** The groups of a kind that have a name or number. */
  std::set<std::size_t> named(const nlohmann::json& name, GroupOf kind) const;
  /** Whether a row of the column of sets is in one of the groups. */
  bool isIn(const std::set<std::size_t>& groups, GroupOf kind, std::size_t row) const;
  std::map<GroupOf, std::set<std::size_t>> groupsAt(
    const nlohmann::json& names, Of of, bool& isEmpty) const;
  std::vector<bool> selectGroups(const nlohmann::json& names, Of of, bool& isEmpty) const;
  std::vector<bool> combine(const nlohmann::json& place, Of of, bool& isEmpty, bool isPart) const;
  /** The vertices, cells or facets whose corners are all among these. */
  std::vector<bool> within(const std::vector<bool>& vertices, Of of) const;
  std::size_t count(Of of) const;
  std::vector<bool> verticesOf(const nlohmann::json& place) const;
  /** Whether a tag or mask holds in a row of its column. */
  static bool holds(const nlohmann::json& place, const CaseColumn& column, std::int64_t row)
  {
    const double value = column.values[static_cast<std::size_t>(row)];
    return place.contains("tag") ? value == place.at("tag")[1].get<double>() : value != 0.0;
  }

  const Case& On;
  std::vector<std::uint8_t> Flags;
  std::vector<Facet> All;
  std::vector<bool> Counts;
  std::vector<std::size_t> Boundary, Inner;
};

} // namespace smg::testing
