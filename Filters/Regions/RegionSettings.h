// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"
#include "smg/Region.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * The mean length of the edges of the block's cells, an edge of several cells counted in each of
 * them; 0 if there are none. The block must have all vertices of its cells.
 */
double meanEdgeLength(const MeshBlock& block, CellType cellType);

/** The settings of a region that is defined by the mesh and its arrays: where an array has a value,
 * where it is not 0, a group, or the boundary. */
struct MarkedRegionSettings
{
  std::string array;         ///< of points or cells, with one component; empty: none
  std::string group;         ///< see InGroup; empty, without an array: the boundary
  std::optional<double> tag; ///< the value of the array; none: any value but 0
  int pieces = 0;            ///< in which the input is requested; 0: chosen

  bool operator==(const MarkedRegionSettings&) const = default;

  bool isBoundary() const { return this->array.empty() && this->group.empty(); }
  /** The region in terms of a problem. */
  Where where() const;
  /** Whether `value`, of an array of float if `isFloat`, is that of the region: a tag of 0.1 is
   * another number in single precision. Throws Error if it is not a number in a mask. */
  bool isMarked(double value, bool isFloat) const;
};

/** The settings of a region that is defined by single points. */
struct PointRegionSettings
{
  enum class Kind
  {
    Selection,
    Ids,
    Points
  };

  Kind kind = Kind::Selection;
  std::vector<std::int64_t> ids;
  bool areOriginalIds = false; ///< else GlobalIds
  std::vector<double> points;  ///< x, y, z of each
  double radius = -1.0;        ///< negative: chosen to suit the points
  int rings = 0;
  int pieces = 0; ///< in which the input is requested; 0: chosen

  bool operator==(const PointRegionSettings&) const = default;

  /** Whether only the points themselves are held. */
  bool isAlone() const { return this->radius <= 0.0 && this->rings == 0; }
  bool isSoughtById() const { return this->kind == Kind::Ids && this->isAlone(); }

  /** Throws Error if settings that the kind needs are missing or invalid. */
  void check(bool hasSelection) const;
};

/** A list of ids to search for, with their indices in the list. */
class IdList
{
public:
  IdList() = default;
  explicit IdList(const std::vector<std::int64_t>& ids);

  /** The index of the id, the first of several; -1 if it is not in the list. */
  std::int64_t numberOf(std::int64_t id) const;
  std::int64_t size() const { return this->Size; }

  /** The first id that `isFound`, by index, does not mark; -1 if there is none. */
  std::int64_t firstMissing(const std::vector<char>& isFound) const;

private:
  std::vector<std::pair<std::int64_t, std::int64_t>> Sorted;
  std::int64_t Size = 0;
};

} // namespace smg
