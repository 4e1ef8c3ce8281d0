// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComposeDescriptions.h"
#include "Testing/Fuzzing/SmallSolve.h"
#include "Testing/Fuzzing/SolverTargets.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/MemoryMesh.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/Distance.h"

namespace smg::testing
{

namespace
{

/** Small meshes of both kinds, with columns of every kind. */
const MemoryMesh& meshOf(CellChoice cells)
{
  constexpr std::int64_t BlockCells = 30;
  static const MemoryMesh solid(describedMesh(), BlockCells);
  static const MemoryMesh surface(describedMesh(grid(9, 8, 0.1)), BlockCells);
  return cells == CellChoice::Triangles ? surface : solid;
}

/** Reads the stream with the columns of `described`: a DescribedProblem or DescribedHandles. */
std::unique_ptr<MeshSource> sourceOf(const MemoryMesh& mesh, const auto& described)
{
  return mesh.source(described.vertexColumns(), described.cellColumns());
}

/** The problem of the bytes; for some lengths with a default, or composed of two of the same. */
ProblemDescription problemOf(std::string_view bytes, const std::string& name)
{
  ProblemDescription defaults;
  if (bytes.size() % 2 == 1)
  {
    defaults.screening = 0.5;
  }
  ProblemDescription problem = readProblemText(std::string(bytes), name, defaults);
  if (bytes.size() % 3 == 1)
  {
    append(problem, ProblemDescription(problem));
  }
  return problem;
}

} // namespace

bool runProblem(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.path("problem.json");
  const MemoryMesh& mesh = meshOf(cells);
  return place.run(
    [&]
    {
      DescribedProblem problem(problemOf(bytes, path.string()), mesh.info(), path.string());
      problem.prepare(*sourceOf(mesh, problem), place.workspace().folder());
      ofFile(path,
        [&] {
          checkSolution(
            *solve(*sourceOf(mesh, problem), problem, smallSolve()), Missing::Undetermined);
        });
    });
}

bool runHandles(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.write("handles.json", bytes);
  const MemoryMesh& mesh = meshOf(cells);
  return place.run(
    [&]
    {
      const DeformationDescription description = readHandleFile(path);
      DescribedHandles handles(description, mesh.info(), path.string());
      handles.prepare(*sourceOf(mesh, handles), place.workspace().folder());
      auto options = smallSolve<DeformOptions>();
      description.applyTo(options);
      options.cycles = std::min(options.cycles, options.maxCycles);
      ofFile(path, [&] { checkSolution(*deform(*sourceOf(mesh, handles), handles, options)); });
    });
}

bool runPlaces(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  const std::filesystem::path path = place.path("places.json");
  const MemoryMesh& mesh = meshOf(cells);
  return place.run(
    [&]
    {
      DistanceDescription description;
      description.from = readPlacesText(std::string(bytes), path.string());
      description.wall = cells == CellChoice::Tetrahedra;
      description.source = description.direction = true;
      DistanceOptions options;
      options.memoryLimit = Workspace::MinMemory;
      options.threads = 1;
      options.scratch = place.workspace().folder();
      ofFile(path,
        [&] {
          checkSolution(*distance(mesh, description, options, path.string()), Missing::Unreached);
        });
    });
}

} // namespace smg::testing
