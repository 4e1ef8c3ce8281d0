// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "Solver/Distributed/SharedVertices.h"
#include "smg/Export.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace smg
{

/** The connected components of a mesh in parts. A component whose vertices all belong to one
 * process is known to that process alone; all others are known to every process, with the sums
 * over all of them. */
class SharedComponents
{
public:
  /** The component of an own vertex. */
  struct Place
  {
    Components* components = nullptr; ///< null: none
    std::int32_t label = -1;          ///< a root of these
  };

  /** `labels`: the labels of the vertices of the part, found from its cells alone: 0 to below
   * `count`, or -1 for no component. Called on all processes. */
  SharedComponents(const SharedVertices& vertices, std::span<const std::int32_t> labels,
    std::int32_t count, int columns);

  /** The component of own vertex number k, from 0. */
  Place of(std::int64_t k);

  /** To be called when the own vertices have been counted: sums over the processes. */
  void combine();

  // On all processes, after that:
  std::int64_t components() const;
  std::int64_t freeComponents() const;
  std::int64_t floatingComponents() const;
  /** See Components. */
  double incompatibility() const;
  std::vector<double> shiftedSums() const;
  /** Chooses the first vertex with chosen(k) of each component whose matrix has constants in its
   * kernel; each is returned on the process that owns it, as its number among the own vertices. */
  std::vector<std::int64_t> representatives(const std::function<bool(std::int64_t)>& chosen);

  /** Numbers of the own and of the shared components, `columns` each; none are zeros. */
  struct Shifts
  {
    const Components* whole;
    std::vector<double> ofWhole, ofSplit;

    double operator()(const Place& place, int columns, int column) const
    {
      const std::vector<double>& shifts = place.components == this->whole ? ofWhole : ofSplit;
      return shifts.empty()
               ? 0.0
               : shifts[static_cast<std::size_t>(place.label) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(column)];
    }
  };
  Shifts rightSideShifts() const;
  Shifts initialMeans() const;
  /** Components::meanShifts(), given the weighted values value(k, column) of own vertices k of free
   * components. */
  Shifts meanShifts(const std::function<double(std::int64_t, int)>& value);

private:
  std::vector<std::int64_t> namesOf(std::span<const std::int32_t> labels, std::int32_t count);
  void findSplit(const std::vector<std::int64_t>& names);

  const SharedVertices& Vertices;
  int Columns;
  Components Whole, Split;
  std::int64_t FirstName = 0;            ///< name of label 0 of this process
  std::vector<std::int64_t> SplitNames;  ///< ascending: the names of the labels of Split
  std::vector<std::int64_t> Names;       ///< of own vertices: the names of their labels
  std::vector<std::int32_t> WholeLabels; ///< label in Whole of each label of the part; -1: none yet
};

} // namespace smg
