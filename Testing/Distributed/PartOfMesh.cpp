// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Distributed/PartOfMesh.h"

#include "Testing/Support/SolveMesh.h"

#include <algorithm>

namespace smg::testing
{

int rankOfTest()
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int sizeOfTest()
{
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

std::vector<std::int64_t> evenCuts(std::int64_t cells, int processes)
{
  std::vector<std::int64_t> cuts;
  for (int p = 0; p <= processes; ++p)
  {
    cuts.push_back(cells * p / processes);
  }
  return cuts;
}

std::vector<std::int64_t> cutsWithGaps(std::int64_t cells, int processes, int first)
{
  std::vector<std::int64_t> cuts = evenCuts(cells, processes);
  for (int p = first; p < processes; p += 2)
  {
    cuts[static_cast<std::size_t>(p) + 1] = cuts[static_cast<std::size_t>(p)];
  }
  cuts.back() = cells; // the last process has the rest
  return cuts;
}

namespace
{

/** The number of vertices that the cells before `cell` use. */
std::int64_t introducedBefore(const StreamMesh& mesh, std::int64_t cell)
{
  const auto end = mesh.corners.begin() + cell * cornersOf(mesh.cellType);
  return cell == 0 ? 0 : *std::max_element(mesh.corners.begin(), end) + 1;
}

/** The rows of a column. */
Column rowsOf(const Column& column, const std::vector<std::int64_t>& rows)
{
  Column some{ column.spec, {} };
  const std::size_t bytes =
    sizeOf(column.spec.type) * static_cast<std::size_t>(column.spec.components);
  for (const std::int64_t row : rows)
  {
    const auto first = column.bytes.begin() + row * static_cast<std::ptrdiff_t>(bytes);
    some.bytes.insert(some.bytes.end(), first, first + static_cast<std::ptrdiff_t>(bytes));
  }
  return some;
}

} // namespace

MeshPart partOf(const StreamMesh& mesh, const std::vector<std::int64_t>& cuts)
{
  const auto rank = static_cast<std::size_t>(rankOfTest());
  const std::int64_t corners = cornersOf(mesh.cellType);
  MeshPart part;
  part.info = MemorySource(mesh).info();
  part.firstOwned = introducedBefore(mesh, cuts[rank]);
  part.endOwned = introducedBefore(mesh, cuts[rank + 1]);
  MeshBlock& block = part.block;
  block.corners.assign(
    mesh.corners.begin() + cuts[rank] * corners, mesh.corners.begin() + cuts[rank + 1] * corners);
  part.ids = block.corners;
  std::ranges::sort(part.ids);
  part.ids.erase(std::unique(part.ids.begin(), part.ids.end()), part.ids.end());
  for (std::int64_t& corner : block.corners)
  {
    corner = std::ranges::lower_bound(part.ids, corner) - part.ids.begin();
  }
  for (const std::int64_t id : part.ids)
  {
    block.positions.insert(
      block.positions.end(), mesh.positions.begin() + 3 * id, mesh.positions.begin() + 3 * id + 3);
  }
  std::vector<std::int64_t> cells;
  for (std::int64_t c = cuts[rank]; c < cuts[rank + 1]; ++c)
  {
    cells.push_back(c);
  }
  for (const Column& column : mesh.vertexColumns)
  {
    block.vertexColumns.push_back(rowsOf(column, part.ids));
  }
  for (const Column& column : mesh.cellColumns)
  {
    block.cellColumns.push_back(rowsOf(column, cells));
  }
  return part;
}

StreamMesh meshOf(const MeshPart& part)
{
  StreamMesh mesh;
  mesh.cellType = part.info.cellType;
  mesh.positions = part.block.positions;
  mesh.corners = part.block.corners;
  return mesh;
}

Eigen::MatrixXd wholeSolution(DistributedSolver& solver, const DistributedSolution& solution)
{
  Eigen::MatrixXd values(0, solution.columns);
  solver.gather(solution, [&values](Solution& whole) { values = valuesOf(whole); });
  return values;
}

} // namespace smg::testing
