// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/DescribedProblem.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using Entity = std::vector<std::int64_t>; ///< vertices

/** A mesh as a file of Gmsh, in which each facet at this coordinate along an axis is in the group
 * of this number; those with two cells come twice. */
std::string textOf(
  const IndexedTestMesh& mesh, std::size_t axis, const std::vector<std::pair<int, double>>& groups)
{
  const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::string elements;
  std::int64_t number = 0;
  const auto element = [&](int group, const Entity& entity)
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
    const Entity cell(begin, begin + static_cast<std::ptrdiff_t>(count));
    element(1, cell);
    for (std::size_t k = 0; k < count; ++k)
    {
      Entity facet = cell;
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

} // namespace

class InnerFacets : public ::testing::TestWithParam<CellType>
{
protected:
  TemporaryFolder Folder;
};

/** A wall between two ends at 0, with a film in it that gives off 3 per area: u is linear on both
 * sides of the film, with slopes whose difference is 3, which linear elements represent. */
TEST_P(InnerFacets, HaveAFluxOnce)
{
  const bool isSurface = this->GetParam() == CellType::Triangle;
  IndexedTestMesh mesh = isSurface ? grid(7, 5) : tetBox(4, 3, 3);
  for (std::size_t v = 0; isSurface && v < static_cast<std::size_t>(mesh.vertices()); ++v)
  {
    // With straight sides, through which nothing flows.
    mesh.positions[3 * v] = static_cast<double>(v % 7);
    mesh.positions[3 * v + 1] = static_cast<double>(v / 7);
  }
  const std::size_t axis = isSurface ? 1 : 0;
  constexpr double Film = 1.0;
  const double far = isSurface ? 4.0 : 3.0;
  writeBytes(
    this->Folder / "wall.msh", textOf(mesh, axis, { { 7, 0.0 }, { 8, far }, { 9, Film } }));
  convert(this->Folder / "wall.msh", this->Folder / "wall.vsm");

  const VsmReader reader(this->Folder / "wall.vsm");
  ProblemDescription wall;
  wall.dirichlet = { { InGroup{ { "7", "8" } }, 0.0 } };
  wall.flux = { { InGroup{ { "9" } }, 3.0 } };
  SolveOptions options;
  options.tolerance = 1e-12;
  const auto solution = solve(reader, wall, options);
  const auto source = reader.source({}, {});
  for (MeshBlock block; source->next(block);)
  {
    std::vector<double> values(static_cast<std::size_t>(block.vertices()));
    solution->read(block.firstVertex, block.vertices(), values);
    for (std::size_t v = 0; v < values.size(); ++v)
    {
      const double at = block.positions[3 * v + axis];
      const double top = 3.0 * Film * (far - Film) / far;
      EXPECT_NEAR(values[v], top * (at < Film ? at / Film : (far - at) / (far - Film)), 1e-7);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfCells, InnerFacets,
  ::testing::Values(CellType::Triangle, CellType::Tetrahedron),
  [](const auto& info) { return info.param == CellType::Triangle ? "Triangles" : "Tetrahedra"; });

} // namespace smg::testing
