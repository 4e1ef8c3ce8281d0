// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Preview/StreamPreview.h"
#include "Testing/Fuzzing/SealedVsm.h"
#include "Testing/Fuzzing/SmallSolve.h"
#include "Testing/Fuzzing/SolverTargets.h"
#include "smg/DescribedProblem.h"
#include "smg/Distance.h"
#include "smg/SolvedMesh.h"
#include "smg/VsmReader.h"

namespace smg::testing
{

namespace
{

/** The positions, smoothed, with a boundary where there is one. */
ProblemDescription problemFor(Weights weights)
{
  ProblemDescription problem;
  problem.columns = 3;
  problem.weights = weights;
  problem.screening = 1.0;
  problem.source = Position{};
  problem.gradientOutput = problem.fluxOutput = true;
  return problem;
}

void solveOn(const VsmReader& mesh, Weights weights)
{
  const ProblemDescription description = problemFor(weights);
  DescribedProblem problem(description, mesh.info());
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source(), FuzzPlace::instance().workspace().folder());
  const std::unique_ptr<Solution> solution = solve(*source(), problem, smallSolve());
  checkSolution(*solution, Missing::Undetermined);
  SolvedMesh solved(mesh, problem, *solution,
    { .gradient = true, .flux = true, .memoryLimit = Workspace::MinMemory, .threads = 1 });
  for (MeshBlock block; solved.next(block);)
  {
    // All results are computed.
  }
  Report report = solution->report();
  solved.finish(report);
}

void measureOn(const VsmReader& mesh)
{
  DistanceDescription description;
  description.from = { NearestVertices{ { { 0.0, 0.0, 0.0 } } } };
  description.source = true;
  DistanceOptions options;
  options.memoryLimit = Workspace::MinMemory;
  options.threads = 1;
  options.maxPasses = 3;
  options.scratch = FuzzPlace::instance().workspace().folder();
  checkSolution(*distance(mesh, description, options), Missing::Unreached);
}

void previewOf(VsmReader& mesh)
{
  for (const SolidPreviewCells cells :
    { SolidPreviewCells::Triangles, SolidPreviewCells::Tetrahedra })
  {
    const MeshPiece piece = makePreviewPiece(mesh, MinPreviewPoints, {}, cells);
    mustHold(std::ranges::all_of(piece.corners,
               [&](std::int64_t corner) { return corner >= 0 && corner < piece.vertices(); }),
      "a corner is no point of the preview");
    mustHold(piece.vertices() <= std::max(MinPreviewPoints, mesh.info().vertices),
      "the preview has too many points");
  }
}

/** The bytes as a .vsm file; streams are converted. Throws Error. */
std::filesystem::path containerOf(std::string_view bytes)
{
  FuzzPlace& place = FuzzPlace::instance();
  if (bytes.starts_with(BlockFileMagic))
  {
    return place.write("solve.vsm", sealedVsm(bytes));
  }
  const std::filesystem::path stream = place.write("solve", bytes);
  const std::filesystem::path container = place.path("solve.vsm");
  std::filesystem::remove(container);
  streamToVsm(stream, container);
  return container;
}

} // namespace

bool runSolve(std::string_view bytes, CellChoice cells)
{
  FuzzPlace& place = FuzzPlace::instance();
  return place.run(
    [&]
    {
      VsmReader mesh(containerOf(bytes));
      ofFile(mesh.path(),
        [&]
        {
          solveOn(mesh, cells == CellChoice::Triangles ? Weights::Cotangent : Weights::Clamped);
          measureOn(mesh);
          previewOf(mesh);
        });
    });
}

} // namespace smg::testing
