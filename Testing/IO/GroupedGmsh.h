// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/IO/MeshText.h"
#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** A mesh as a file of Gmsh, in which each facet at this coordinate along an axis is in the group
 * of this number; those with two cells come twice. */
inline std::string gmshText(
  const IndexedTestMesh& mesh, std::size_t axis, const std::vector<std::pair<int, double>>& groups)
{
  const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::string elements;
  std::int64_t number = 0;
  const auto element = [&](int group, const std::vector<std::int64_t>& entity)
  {
    constexpr int Types[] = { 0, 15, 1, 2, 4 }; // of Gmsh, by the number of corners
    elements += std::to_string(++number) + ' ' + std::to_string(Types[entity.size()]) + " 2 " +
                std::to_string(group) + " 1";
    for (const std::int64_t v : entity)
    {
      elements += ' ' + std::to_string(v + 1);
    }
    elements += '\n';
  };
  for (std::size_t at = 0; at < mesh.corners.size(); at += count)
  {
    const auto begin = mesh.corners.begin() + static_cast<std::ptrdiff_t>(at);
    const std::vector<std::int64_t> cell(begin, begin + static_cast<std::ptrdiff_t>(count));
    element(1, cell);
    for (std::size_t k = 0; k < count; ++k)
    {
      std::vector<std::int64_t> facet = cell;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
      for (const auto& [group, place] : groups)
      {
        const auto isAtPlace = [&, place = place](std::int64_t v)
        { return mesh.positions[static_cast<std::size_t>(3 * v) + axis] == place; };
        if (std::ranges::all_of(facet, isAtPlace))
        {
          element(group, facet);
        }
      }
    }
  }
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  text += std::to_string(mesh.vertices()) + '\n';
  for (std::size_t v = 0; v < static_cast<std::size_t>(mesh.vertices()); ++v)
  {
    text += std::to_string(v + 1) + ' ' + exact(mesh.positions[3 * v]) + ' ' +
            exact(mesh.positions[3 * v + 1]) + ' ' + exact(mesh.positions[3 * v + 2]) + '\n';
  }
  return text + "$EndNodes\n$Elements\n" + std::to_string(number) + '\n' + elements +
         "$EndElements\n";
}

} // namespace smg::testing
