// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemorySource.h"
#include "smg/DescribedProblem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{

/**
 * A mesh, by default a box of tetrahedra, with columns for problem descriptions: of the vertices
 * "one" (one number), "three" (three), "mask" (1 where y is at most 1) and "nan" (no number); of
 * the cells "k", "diagonal", "K", "q" (conductivities and a vector), "tag" (3 where all corners
 * have x of at most 1, else 1) and "cellMask" (1 where "tag" is 3).
 */
inline StreamMesh describedMesh(const IndexedTestMesh& shape = tetBox(4, 3, 3, 0.1))
{
  StreamMesh mesh = toStream(shape);
  const int corners = cornersOf(mesh.cellType);
  Random random(5);
  const auto numbers = [&random](std::int64_t count, double low, double high)
  {
    std::vector<double> values(static_cast<std::size_t>(count));
    std::ranges::generate(values, [&] { return random.uniform(low, high); });
    return values;
  };
  std::vector<std::uint8_t> mask, cellMask;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    mask.push_back(mesh.positions[3 * v + 1] < 1.5 ? 1 : 0);
  }
  std::vector<std::int32_t> tag;
  std::vector<double> tensor = numbers(6 * mesh.cells(), 0.0, 0.3);
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    bool isLeft = true;
    for (int k = 0; k < corners; ++k)
    {
      isLeft = isLeft && mesh.positions[3 * mesh.corners[corners * c + k]] < 1.5;
      tensor[6 * c + k % 3] += 1.0;
    }
    tag.push_back(isLeft ? 3 : 1);
    cellMask.push_back(isLeft ? 1 : 0);
  }
  const auto vertices = mesh.vertices(), cells = mesh.cells();
  mesh.vertexColumns = { makeColumn<double>("one", numbers(vertices, 0.5, 2.0)),
    makeColumn<double>("three", numbers(3 * vertices, -1.0, 1.0), 3),
    makeColumn<std::uint8_t>("mask", mask),
    makeColumn<double>("nan", std::vector<double>(static_cast<std::size_t>(vertices), NAN)) };
  mesh.cellColumns = { makeColumn<double>("k", numbers(cells, 0.5, 2.0)),
    makeColumn<double>("diagonal", numbers(3 * cells, 0.5, 2.0), 3),
    makeColumn<double>("K", tensor, 6), makeColumn<double>("q", numbers(3 * cells, -1.0, 1.0), 3),
    makeColumn<std::int32_t>("tag", tag), makeColumn<std::uint8_t>("cellMask", cellMask) };
  return mesh;
}

/** A problem on it with every datum, every type of value and every type of place. */
inline constexpr const char* EveryDatumOfDescribedMesh = R"({ "weights": "clamped", "columns": 3,
  "conductivity": [ {"value": [2, 3, 4, 0.5, 0.25, 0.125]}, {"tag": ["tag", 3], "value": "K"},
                    {"box": [1.5, -1, -1, 9, 9, 9], "value": 2.5}, {"mask": "cellMask", "value": "k"} ],
  "screening": [ {"value": 0.5}, {"nearest": [[1, 1, 1], [2, 0, 0]], "value": "one"} ],
  "source": [ {"value": [1, 2, 3]}, {"halfspace": [0, 0, 1, 1.5], "value": "three"},
              {"sphere": [0, 0, 0, 1.5], "value": "position"} ],
  "field": "q",
  "initial": "three",
  "dirichlet": [ {"tag": ["tag", 3], "value": "position"}, {"mask": "mask", "value": "three"},
                 {"vertices": [3, 7], "value": [4, 5, 6]} ],
  "flux": [ {"box": [-9, -9, -9, 9, 9, 0.5], "value": [1, 0, 2]}, {"mask": "cellMask", "value": "q"} ],
  "robin": [ {"halfspace": [1, 0, 0, 2.5], "coefficient": 2, "ambient": [3, 4, 5]},
             {"mask": "mask", "coefficient": [ {"value": "one"}, {"tag": ["tag", 3], "value": "k"} ],
              "ambient": "position"} ],
  "soft": [ {"mask": "mask", "weight": 3, "value": "three"},
            {"tag": ["tag", 1], "weight": "one", "value": [1, 1, 1]},
            {"boundary": true, "weight": 0.5, "value": "position"} ],
  "outputs": ["gradient", "flux"] })";

/** All data of a problem on a mesh. */
struct ProblemAnswers
{
  VertexConditions vertices;
  std::vector<double> weight, screening, source, field, conductivity; // of cells
  std::vector<std::int32_t> flux, robin;                              // of facets
  std::vector<double> fluxValue, coefficient, ambient;

  bool operator==(const ProblemAnswers& other) const
  {
    return this->vertices.dirichlet == other.vertices.dirichlet &&
           this->vertices.value == other.vertices.value &&
           this->vertices.source == other.vertices.source &&
           this->vertices.screening == other.vertices.screening && this->weight == other.weight &&
           this->screening == other.screening && this->source == other.source &&
           this->field == other.field && this->conductivity == other.conductivity &&
           this->flux == other.flux && this->robin == other.robin &&
           this->fluxValue == other.fluxValue && this->coefficient == other.coefficient &&
           this->ambient == other.ambient;
  }
};

/** Queries a problem like the engine, `batch` cells at a time. The weights on entry are 1. */
ProblemAnswers answersOf(Problem& problem, MeshSource& mesh, std::size_t batch = 5);

} // namespace smg::testing
