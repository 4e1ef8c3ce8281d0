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

} // namespace

class InnerFacets : public ::testing::TestWithParam<CellType>
{
protected:
  TemporaryFolder Folder;
};

/** A wall between two ends at 0, with a film at x = 1 that gives off 3 per area: u is linear on
 * both sides of it, with slopes whose difference is 3, which linear elements represent. */
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
  const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const std::size_t axis = isSurface ? 1 : 0;
  const auto x = [&](std::int64_t v)
  { return mesh.positions[static_cast<std::size_t>(3 * v) + axis]; };
  constexpr double film = 1.0;
  double far = 0.0;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    far = std::max(far, x(v));
  }
  // Each facet as often as there are cells: it is one all the same.
  std::string elements;
  std::int64_t number = 0;
  const auto element = [&](std::size_t size, int group, const Entity& entity)
  {
    constexpr int Types[] = { 0, 15, 1, 2, 4 };
    elements += std::to_string(++number) + ' ' + std::to_string(Types[size]) + " 2 " +
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
    element(count, 1, cell);
    for (std::size_t k = 0; k < count; ++k)
    {
      Entity facet = cell;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
      for (const auto& [group, place] : { std::pair(7, 0.0), { 8, far }, { 9, film } })
      {
        if (std::ranges::all_of(
              facet, [&](std::int64_t v) { return std::fabs(x(v) - place) < 1e-9; }))
        {
          element(count - 1, group, facet);
        }
      }
    }
  }
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  text += std::to_string(mesh.vertices()) + '\n';
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const auto at = static_cast<std::size_t>(3 * v);
    text += std::to_string(v + 1) + ' ' + exact(mesh.positions[at]) + ' ' +
            exact(mesh.positions[at + 1]) + ' ' + exact(mesh.positions[at + 2]) + '\n';
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(number) + '\n' + elements + "$EndElements\n";
  writeBytes(this->Folder / "wall.msh", text);
  convert(this->Folder / "wall.msh", this->Folder / "wall.vsm");

  const VsmReader reader(this->Folder / "wall.vsm");
  ProblemDescription wall;
  wall.dirichlet = { { InGroup{ { "7", "8" } }, 0.0 } };
  wall.flux = { { InGroup{ { "9" } }, 3.0 } };
  DescribedProblem problem(wall, reader.info());
  const auto source = [&] { return reader.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source());
  SolveOptions options;
  options.tolerance = 1e-12;
  const auto solution = solve(*source(), problem, options);
  std::vector<std::int64_t> ids;
  const auto numbers = reader.source({ OriginalIdName }, {});
  for (MeshBlock block; numbers->next(block);)
  {
    const auto of = std::as_const(block.vertexColumns[0]).as<std::int64_t>();
    ids.insert(ids.end(), of.begin(), of.end());
  }
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    double u = 0.0;
    solution->read(v, 1, std::span(&u, 1));
    const double at = x(ids[static_cast<std::size_t>(v)]);
    const double top = 3.0 * film * (far - film) / far;
    EXPECT_NEAR(u, top * (at < film ? at / film : (far - at) / (far - film)), 1e-7) << v;
  }
}

INSTANTIATE_TEST_SUITE_P(OfCells, InnerFacets,
  ::testing::Values(CellType::Triangle, CellType::Tetrahedron),
  [](const auto& info) { return info.param == CellType::Triangle ? "Triangles" : "Tetrahedra"; });

} // namespace smg::testing
