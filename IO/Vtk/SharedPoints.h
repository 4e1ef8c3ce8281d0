// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/**
 * Compares what pieces in order say of the points that they share: positions and columns. A filter
 * that computes from neighbours, which a piece lacks at its border, gives other values in each.
 * Keeps those of the points that later pieces use, at most Most numbers: what is beyond is not
 * compared.
 */
class SharedPoints
{
public:
  static constexpr std::size_t Most = std::size_t(1) << 20;

  /**
   * Adds a piece.
   * @param ids of all its points
   * @param block the points that it owns, with their columns, and the cells that it owns
   * @param isFinal whether no later piece uses a point
   * @param where the place of the piece, for errors
   * @return whether it has other values at points that an earlier piece owns
   */
  bool add(vtkPointSet& piece, const std::vector<std::int64_t>& ids, const MeshBlock& block,
    const std::function<bool(std::int64_t)>& isFinal, const std::string& where);

private:
  bool differ(vtkPointSet& piece, const std::vector<std::int64_t>& ids, const MeshBlock& block,
    const std::string& where);
  void keep(const MeshBlock& block, const std::function<bool(std::int64_t)>& isFinal);

  std::vector<std::int64_t> Ids; ///< of points that are kept, ascending
  std::vector<double> Values;    ///< theirs
  std::vector<double> Scale;     ///< the largest value of each component so far
};

} // namespace smg
