// SPDX-License-Identifier: BSD-3-Clause
#include "OnProcesses.h"
#include "PieceFiles.h"

#include "IO/Mesh/Columns.h"
#include "IO/Results/MovedPoints.h"
#include "IO/Results/VertexNormals.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/MovedMesh.h"

#include <algorithm>
#include <optional>
#include <span>

namespace
{

/** Rounds the positions of the vertices of a part, as files with single precision have them. */
void roundPositions(const smg::MeshPart& part, std::span<double> positions)
{
  for (std::size_t v = 0; v < part.ids.size(); ++v)
  {
    const std::span<double, 3> position = positions.subspan(3 * v).first<3>();
    std::ranges::copy(
      smg::singlePrecision(position, part.ids[v], "The moved mesh"), position.begin());
  }
}

/** Adds the normals that the mesh has, of the moved triangles of all processes. */
void addNormals(smg::Team& team, smg::DistributedSolver& solver, const smg::VsmReader& mesh,
  const smg::MeshPart& part, PieceResult& result)
{
  const smg::MeshBlock& block = part.block;
  smg::TriangleView triangles{ result.positions, block.corners, {} };
  const std::ptrdiff_t flags =
    smg::findColumn(block.cellColumns, { smg::CellFlagsName, smg::ScalarType::UInt8, 1 });
  if (flags >= 0)
  {
    triangles.flags = block.cellColumns[static_cast<std::size_t>(flags)].as<std::uint8_t>();
  }
  if (std::ranges::any_of(mesh.info().vertexColumns, smg::isNormals))
  {
    std::vector<double> sums;
    team.run([&] { sums = smg::normalSums(triangles); });
    solver.sum(sums, 3);
    team.run(
      [&] { PieceResult::add(result.vertexColumns, smg::NormalsName, 3, smg::unitNormals(sums)); });
  }
  if (std::ranges::any_of(mesh.info().cellColumns, smg::isNormals))
  {
    team.run([&]
      { PieceResult::add(result.cellColumns, smg::NormalsName, 3, smg::normalsOf(triangles)); });
  }
}

/** Adds the cells of all processes that the deformation inverts to the report of the first one. */
void addInverted(smg::Team& team, const smg::MeshPart& part, const DistributedJob& job,
  const std::vector<double>& positions, smg::Report& report)
{
  team.run(
    [&]
    {
      smg::InvertedCells cells(part.info, job.scratch, smg::NormalsOptions().memory);
      smg::MeshBlock moved = part.block;
      moved.positions = positions;
      cells.add(part.block.positions, moved);
      const auto found = team.gather(std::vector<smg::Report::Inverted>{ cells.found() });
      for (int process = 1; team.rank() == 0 && process < team.size(); ++process)
      {
        cells.join(found[static_cast<std::size_t>(process)]);
      }
      cells.finish(report);
    });
}

} // namespace

void deformOn(smg::Team& team, const DistributedJob& job, const DistributedDeformation& task)
{
  std::optional<smg::DeformationDescription> description;
  const auto on = readDescribed<smg::DescribedHandles>(
    team, job, [&] { return description.emplace(task.read()); });
  smg::DistributedSolver solver(team.communicator(), on.part);
  solver.prepare(*on.described, job.scratch, job.memoryLimit);
  smg::DistributedSolution solution =
    solver.deform(*on.described, *description->weights, optionsOf(job, *description->tolerance));
  const std::vector<std::string> notes = solver.notes(*on.described);
  solution.report.notes.insert(solution.report.notes.end(), notes.begin(), notes.end());
  if (!isInPieces(job.out))
  {
    solver.gather(solution, job.use);
    return;
  }
  PieceResult result;
  result.replaces = smg::isNormals;
  result.positions = std::move(solution.values);
  const smg::StreamInfo& info = on.mesh->info();
  if (!info.doublePositions)
  {
    team.run([&] { roundPositions(on.part, result.positions); });
  }
  addInverted(team, on.part, job, result.positions, solution.report);
  if (task.normals == smg::MovedNormals::Recompute && info.cellType == smg::CellType::Triangle)
  {
    addNormals(team, solver, *on.mesh, on.part, result);
  }
  writePieceFiles(team, *on.mesh, std::move(result), job.out);
  reportOn(team, job, solution.report);
}
