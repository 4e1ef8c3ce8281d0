// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartResults.h"

#include "Solver/Distributed/SharedElements.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Mesh/AddedColumn.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

// The derived results of a solution in parts. Each process evaluates its own cells with the code of
// the streaming engine; facets and edges between parts are joined before, so that each counts once,
// and what cells contribute to vertices is summed at the owners. Sums over the mesh are reductions,
// so they agree with the results of one stream up to rounding.

namespace smg
{
namespace
{

/** Replaces the sums and minima of this process by those of all processes, in two reductions. */
void sumUp(ResultSums& sums, Team& team)
{
  const auto replace = [](const std::vector<double*>& places, auto reduce)
  {
    std::vector<double> numbers;
    std::ranges::transform(
      places, std::back_inserter(numbers), [](double* place) { return *place; });
    reduce(numbers);
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      *places[k] = numbers[k];
    }
  };
  const ResultSums::Numbers numbers = sums.numbers();
  replace(numbers.sums, [&team](std::vector<double>& all) { team.sum(all); });
  replace(numbers.least, [&team](std::vector<double>& all) { team.least(all); });
}

/** Replaces the smallest value of each column on this process by the smallest one on all processes,
 * at the first vertex in stream order that has it, under its original number. `sign` -1: the
 * largest value. */
void findExtremes(const SharedVertices& vertices, const MeshPart& part, double sign,
  std::vector<Report::Extreme>& extremes)
{
  // Three reductions: the value; among the vertices with it the first stream index; and its
  // original number, which only the processes that have the vertex know.
  constexpr std::int64_t None = std::numeric_limits<std::int64_t>::max();
  Team& team = vertices.team();
  std::vector<double> values;
  for (const Report::Extreme& extreme : extremes)
  {
    values.push_back(sign * extreme.value);
  }
  team.least(values);
  std::vector<std::int64_t> ids(extremes.size(), None);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    // Comparing for equality is exact: `values` holds a value of one of the processes, not a sum.
    if (extremes[k].vertex >= 0 && sign * extremes[k].value == values[k])
    {
      ids[k] = vertices.id(extremes[k].vertex);
    }
  }
  team.least(ids);
  std::vector<std::int64_t> names = ids;
  const std::ptrdiff_t column = findColumn(part.block.vertexColumns, OriginalIdSpec);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    const std::int64_t vertex = ids[k] == None ? -1 : vertices.find(ids[k]);
    // Asked of the info, which is the same on all processes: the block of a process without cells
    // may have no columns.
    if (findColumn(part.info.vertexColumns, OriginalIdSpec) >= 0)
    {
      names[k] = vertex < 0 ? None
                            : part.block.vertexColumns[static_cast<std::size_t>(column)]
                                .as<std::int64_t>()[static_cast<std::size_t>(vertex)];
    }
  }
  team.least(names);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    extremes[k] = { sign * values[k], names[k] == None ? -1 : names[k] };
  }
}

} // namespace

void evaluatePart(const SharedVertices& vertices, const MeshPart& part, Problem& problem,
  const ResultOptions& options, DistributedSolution& solution)
{
  const CellType type = part.info.cellType;
  InMemorySolution values(solution.values, solution.columns);
  ProblemResults results(part.info, problem, values, options);
  results.addPart(part.block);
  solution.gradient.assign(results.gradient().begin(), results.gradient().end());
  solution.flux.assign(results.flux().begin(), results.flux().end());
  // Edges between vertices with different conditions carry flux; each is left to one process.
  joinSharedEdges(vertices, results.edges());
  results.exclude(innerFacets(vertices, type, results.facets()));
  std::vector<double> terms = results.takeTerms();
  const auto columns = static_cast<std::size_t>(solution.columns);
  const std::size_t lanes = VertexTerms::size(columns);
  vertices.addToOwners(terms, static_cast<int>(lanes));
  ResultSums& sums = results.sums();
  // Each vertex is counted by its owner alone.
  for (std::int64_t i = vertices.begin(); i < vertices.end(); ++i)
  {
    const auto vertex = static_cast<std::size_t>(i);
    sums.add(VertexTerms(terms.data() + vertex * lanes), solution.values.data() + vertex * columns,
      results.dirichlet(i), 0);
  }
  sumUp(sums, vertices.team());
  findExtremes(vertices, part, 1.0, sums.minimum);
  findExtremes(vertices, part, -1.0, sums.maximum);
  sums.finish(solution.report, false);
}

/** The owner of a vertex collects the marks of all parts and passes the result on. */
void PartsOfMesh::join(std::span<std::uint8_t> marks)
{
  this->Vertices.collect(std::span<const std::uint8_t>(marks),
    [&](std::int64_t vertex, std::uint8_t mark)
    { marks[static_cast<std::size_t>(vertex)] |= mark; });
  this->Vertices.copyFromOwners(marks, 1);
}

/** Of equal distances the vertex that comes first in the stream, whichever process has it: so a
 * point selects the same vertex with any number of processes. */
void PartsOfMesh::nearest(std::span<double> distances, std::span<std::int64_t> vertices)
{
  std::vector<double> least(distances.begin(), distances.end());
  this->Vertices.team().least(least);
  std::vector<std::int64_t> ids(vertices.size(), std::numeric_limits<std::int64_t>::max());
  for (std::size_t n = 0; n < ids.size(); ++n)
  {
    if (vertices[n] >= 0 && distances[n] == least[n])
    {
      ids[n] = this->Vertices.id(vertices[n]);
    }
  }
  this->Vertices.team().least(ids);
  for (std::size_t n = 0; n < ids.size(); ++n)
  {
    distances[n] = least[n];
    vertices[n] = this->Vertices.find(ids[n]);
  }
}

FacetSet PartsOfMesh::innerFacets(const OpenFacets& facets)
{
  return smg::innerFacets(this->Vertices, this->Type, facets);
}

} // namespace smg
