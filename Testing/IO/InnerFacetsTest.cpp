// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/GroupedGmsh.h"
#include "Testing/Support/ErrorMessage.h"
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
class InnerFacets : public ::testing::TestWithParam<CellType>
{
protected:
  /** Solves for a film with this flux, and later entries, and expects a flux of 3. */
  void expectFilm(const Where& film, std::vector<PlacedValue> later, double value = 3.0);

  TemporaryFolder Folder;
};

/** A wall between two ends at 0, with a film in it that gives off 3 per area: u is linear on both
 * sides of the film, with slopes whose difference is 3, which linear elements represent. */
TEST_P(InnerFacets, HaveAFluxOnce)
{
  this->expectFilm(InGroup{ { "9" } }, {});
}

/** The ends are prescribed, and what flows through the sides is 0 by the later entry, too. */
TEST_P(InnerFacets, KeepTheirFluxWhereALaterEntryHoldsEverywhere)
{
  this->expectFilm(InGroup{ { "9" } }, { { Everywhere{}, 0.0 } });
  this->expectFilm(InGroup{ { "9" } }, { { OnBoundary{}, 0.0 } });
  // Of those that are stated for facets, the later one holds.
  this->expectFilm(InGroup{ { "7", "8", "9" } },
    { { Combination{ Combination::Kind::Any, { InGroup{ { "9" } } } }, 3.0 },
      { Everywhere{}, 0.0 } },
    1000.0);
}

INSTANTIATE_TEST_SUITE_P(OfCells, InnerFacets,
  ::testing::Values(CellType::Triangle, CellType::Tetrahedron),
  [](const auto& info) { return info.param == CellType::Triangle ? "Triangles" : "Tetrahedra"; });

void InnerFacets::expectFilm(const Where& film, std::vector<PlacedValue> later, double value)
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
    this->Folder / "wall.msh", gmshText(mesh, axis, { { 7, 0.0 }, { 8, far }, { 9, Film } }));
  convert(this->Folder / "wall.msh", this->Folder / "wall.vsm");

  const VsmReader reader(this->Folder / "wall.vsm");
  ProblemDescription wall;
  wall.dirichlet = { { InGroup{ { "7", "8" } }, 0.0 } };
  wall.flux = { { film, value } };
  wall.flux.insert(wall.flux.end(), later.begin(), later.end());
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
  wall.source = { { InGroup{ { "9" } }, 3.0 } };
  expectError([&] { solve(reader, wall, options); },
    "source[0].group: the group '9' is of facets, but cells are needed here; a source on facets is "
    "a flux");
}

} // namespace smg::testing
