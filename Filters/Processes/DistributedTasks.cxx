// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/DistributedTasks.h"

#include "Filters/Processes/ProcessParts.h"
#include "Filters/Regions/HandleArrays.h"
#include "Filters/Tasks/DeformationTask.h"
#include "Filters/Tasks/DeformedVertices.h"
#include "Filters/Tasks/PoissonTask.h"
#include "IO/Mesh/Columns.h"
#include "IO/Results/VertexNormals.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescribedHandles.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace smg
{
namespace
{

template <class Task>
std::unique_ptr<Task> taskOfType(const TaskOf& taskOf, vtkPointSet& sample)
{
  return std::unique_ptr<Task>(static_cast<Task*>(taskOf(sample).release()));
}

} // namespace

SolveSummary solveInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const TaskOf& taskOf, const ProgressFunction& progress, std::vector<double>& values)
{
  std::unique_ptr<PoissonTask> task;
  ProcessParts parts(piece, controller,
    [&](vtkPointSet& sample)
    {
      task = taskOfType<PoissonTask>(taskOf, sample);
      task->check();
      checkForProcesses(task->asked.solving);
      if (task->asked.description.vertexGradientOutput)
      {
        throw Error("The distributed engine has no gradient at the points: switch GradientAtPoints "
                    "off, or choose the Engine Streaming.");
      }
      std::set<std::string> names = namedColumns(task->asked.description);
      names.insert({ CellFlagsName, OriginalIdName, OriginalCellIdName });
      return names;
    });
  DistributedSolver& solver = parts.solver();
  const StreamInfo& info = parts.part().info;
  std::optional<DescribedProblem> problem;
  std::string text;
  solver.together(
    [&]
    {
      const ProblemDescription description = task->description(info);
      text = textOf(description);
      problem.emplace(description, info);
    });
  parts.requireSame("problem", text);
  const SolveOptions& options = task->asked.solving;
  solver.prepare(*problem, options.scratch, options.memoryLimit);
  DistributedSolution solution = solver.solve(*problem, distributedOptions(options, progress));
  solver.evaluate(*problem, solution,
    { .integrals = task->asked.description.integrals, .memoryLimit = INT64_MAX });
  return parts.summarize(solution.report, task->notes, solution.values, solution.columns, values);
}

namespace
{

void checkDeformation(const DeformationTask& task)
{
  task.check();
  checkForProcesses(task.asked.deforming);
  if (task.asked.deforming.cycles > 0)
  {
    throw Error("The distributed engine has no V-cycles to count: set Cycles to 0, so that "
                "Tolerance ends each step, or choose the Engine Streaming.");
  }
}

/** The positions as the points of the piece hold them. */
std::vector<double> roundedTo(
  vtkPointSet& piece, const MeshPart& part, const std::vector<double>& positions)
{
  std::vector<double> rounded = positions;
  const bool isSingle = piece.GetPoints() && piece.GetPoints()->GetDataType() == VTK_FLOAT;
  for (std::size_t v = 0; isSingle && v < part.ids.size(); ++v)
  {
    const std::span<double, 3> position = std::span(rounded).subspan(3 * v).first<3>();
    std::ranges::copy(singlePrecision(position, part.ids[v], "The moved mesh"), position.begin());
  }
  return rounded;
}

/** The positions of the vertices of the part, and the normals of the moved triangles of all parts
 * there, as DeformedVertices has them. */
std::vector<double> withNormals(
  vtkPointSet& piece, ProcessParts& parts, const std::vector<double>& positions)
{
  const MeshPart& part = parts.part();
  std::vector<double> sums;
  parts.solver().together(
    [&]
    {
      const std::vector<double> rounded = roundedTo(piece, part, positions);
      TriangleView triangles{ rounded, part.block.corners, {} };
      const std::ptrdiff_t flags =
        findColumn(part.block.cellColumns, { CellFlagsName, ScalarType::UInt8, 1 });
      if (flags >= 0)
      {
        triangles.flags =
          part.block.cellColumns[static_cast<std::size_t>(flags)].as<std::uint8_t>();
      }
      sums = normalSums(triangles);
    });
  parts.solver().sum(sums, 3);
  std::vector<double> values;
  parts.solver().together(
    [&]
    {
      const std::vector<float> normals = unitNormals(sums);
      values.reserve(2 * positions.size());
      for (std::size_t k = 0; k < positions.size(); k += 3)
      {
        const auto first = static_cast<std::ptrdiff_t>(k);
        values.insert(values.end(), positions.begin() + first, positions.begin() + first + 3);
        values.insert(values.end(), normals.begin() + first, normals.begin() + first + 3);
      }
    });
  return values;
}

} // namespace

SolveSummary deformInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const TaskOf& taskOf, const ProgressFunction& progress, std::vector<double>& values)
{
  std::unique_ptr<DeformationTask> task;
  ProcessParts parts(piece, controller,
    [&](vtkPointSet& sample)
    {
      task = taskOfType<DeformationTask>(taskOf, sample);
      checkDeformation(*task);
      const auto& arrays = HandleArrays::names();
      std::set<std::string> names(arrays.begin(), arrays.end());
      names.insert({ CellFlagsName, OriginalIdName });
      return names;
    });
  DistributedSolver& solver = parts.solver();
  const StreamInfo& info = parts.part().info;
  std::optional<DescribedHandles> handles;
  solver.together([&] { handles.emplace(DeformationDescription::byColumns(), info); });
  parts.requireSame("treatment of normals", task->needsNormals ? "recompute" : "drop");
  const DeformOptions& options = task->asked.deforming;
  DistributedSolution solution =
    solver.deform(*handles, options.weights, distributedOptions(options, progress));
  int columns = solution.columns;
  if (task->needsNormals && info.cellType == CellType::Triangle)
  {
    columns = DeformedVertices::WithNormals;
    solution.values = withNormals(piece, parts, solution.values);
  }
  return parts.summarize(solution.report, task->notes, solution.values, columns, values);
}

} // namespace smg
