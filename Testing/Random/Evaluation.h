// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"

#include <Eigen/Core>

#include <cstdint>
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

  /** The vertices, cells or facets of a place; sets `isEmpty` if there are none. */
  std::vector<bool> select(const nlohmann::json& place, Of of, bool& isEmpty) const;
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
  /** Whether an entry names a column of the cells. */
  bool namesCells(const nlohmann::json& entry) const
  {
    return this->cellColumn(entry.at("value")) ||
           (entry.contains("mask") && this->cellColumn(entry.at("mask"))) ||
           (entry.contains("tag") && this->cellColumn(entry.at("tag")[0]));
  }

  /** The boundary facets in any of these places; of no place, all of them. */
  std::vector<std::size_t> walls(const nlohmann::json& places) const;

private:
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
  std::vector<std::size_t> Boundary;
};

} // namespace smg::testing
