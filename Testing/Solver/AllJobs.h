// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/BlendTesting.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Solver/Jobs.h"
#include "Testing/Solver/SmoothTesting.h"
#include "smg/Area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

// The jobs that the laws hold for: each kind of computation, and several of one kind where they
// take other paths.

namespace smg::testing
{

/** A few V-cycles, whatever they reach. */
inline SolveOptions fewCycles(
  int cycles = 3, AccelerationKind acceleration = AccelerationKind::Automatic, int sweeps = 2)
{
  SolveOptions options;
  options.tolerance = 1e-12;
  options.maxCycles = cycles;
  options.acceleration = acceleration;
  options.sweeps = sweeps;
  return options;
}

inline JobRun solving(const ArrayProblem& given, const SolveOptions& what)
{
  return [=](const StoredMesh& mesh, const Way& way)
  {
    ArrayProblem problem = given;
    return solve(*mesh.source({}, {}), problem, way.with(what));
  };
}

/** Nothing is prescribed; so each component is a free one. */
inline ArrayProblem freeProblem(const StreamMesh& mesh)
{
  ArrayProblem problem;
  problem.Columns = 2;
  Random random(3);
  for (std::int64_t i = 0; i < 2 * mesh.vertices(); ++i)
  {
    problem.Source.push_back(random.uniform(-1.0, 1.0));
    problem.Value.push_back(random.uniform(-1.0, 1.0));
  }
  return problem;
}

/** With sources, targets and screening. */
inline ArrayProblem problemOfAllData(const StreamMesh& mesh)
{
  ArrayProblem problem = heldEnds(mesh, 2, Weights::Clamped);
  problem.Source = freeProblem(mesh).Source;
  problem.Screening = 0.5;
  problem.Target = [](const double* p, const double* q, double* d)
  {
    d[0] = p[0] * q[1] - p[1] * q[0];
    d[1] = p[2] - q[2];
  };
  return problem;
}

/** A described problem with columns of cells and vertices, which is prepared by a reading. */
inline JobRun describedProblem(StreamMesh& mesh)
{
  addColumn(mesh, "k", { [](const double* p) { return 1.5 + 0.5 * std::sin(p[0]); } });
  std::vector<std::int32_t> tags;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    tags.push_back(mesh.corners[static_cast<std::size_t>(cornersOf(mesh.cellType) * c)] % 3 == 0);
  }
  mesh.cellColumns.push_back(makeColumn<std::int32_t>("tag", tags));
  ProblemDescription description;
  description.conductivity = { { Everywhere{}, "k" }, { ColumnTag{ "tag", 1 }, 5.0 } };
  description.source = { { Everywhere{}, "k" } };
  description.dirichlet = { { NearestVertices{ { { 0, 0, 0 }, { 9, 9, 9 } } }, 1.0 } };
  return [=](const StoredMesh& stored, const Way& way)
  { return solve(stored, description, way.with(fewCycles())); };
}

inline JobRun deforming(const StreamMesh& mesh, const DeformOptions& what)
{
  const ArrayHandles given = figureHandles(mesh);
  return [=](const StoredMesh& stored, const Way& way)
  {
    ArrayHandles handles = given;
    return deform(*stored.source({}, {}), handles, way.with(what));
  };
}

inline JobRun smoothing(std::optional<double> keepEdges, const std::string& column = "")
{
  Smoothing what;
  what.steps = 2;
  what.keepEdges = keepEdges;
  what.column = column;
  return [=](const StoredMesh& mesh, const Way& way)
  {
    const Smoothing options = way.with(what);
    return smooth(mesh, options, options);
  };
}

inline JobRun blending(StreamMesh& mesh, SeamGradient seam)
{
  addColumn<std::int32_t>(mesh, "patch", { quarter });
  addColumn(mesh, "signal", { recordedSignal, [](const double* p) { return quarter(p) * p[2]; } });
  BlendDescription description = blendOf({ "signal" });
  description.seam = seam;
  return [=](const StoredMesh& stored, const Way& way)
  { return blend(stored, description, way.with(SolveOptions())); };
}

/** Shares of vertices in the cells of a part. */
inline JobRun sharing(AreaShare share)
{
  AreaDescription description;
  description.share = share;
  description.of = { Region(Region::HalfSpace{ { 1, 0, 0 }, 0.5 }) };
  return [description](const StoredMesh& mesh, const Way& way)
  { return area(mesh, description, way.with(SolveOptions())); };
}

inline DistanceDescription distanceOf(const StreamMesh& mesh, bool wall)
{
  DistanceDescription description;
  if (!wall)
  {
    description = fromVertices({ 5, 6, mesh.vertices() / 2 });
  }
  description.wall = wall;
  description.source = description.direction = true;
  return description;
}

inline JobRun measuring(const StreamMesh& mesh, bool wall)
{
  return [description = distanceOf(mesh, wall)](const StoredMesh& stored, const Way& way)
  { return distance(stored, description, way.with(DistanceOptions())); };
}

/** A distance in chunks, whose number of vertices follows from the span. */
inline JobRun measuringInChunks(const StreamMesh& mesh)
{
  DistanceDescription description = distanceOf(mesh, false);
  // The number of intervals of an exact front has no law.
  description.accuracy = PathAccuracy::Approximate;
  return [description](const StoredMesh& stored, const Way& way)
  {
    return pathDistance(stored, description,
      std::make_unique<DistanceRun>(way.with(DistanceOptions())), "distance",
      4 * stored.info().span);
  };
}

inline const Job AllJobs[] = {
  { .name = "Solve",
    .on = [](StreamMesh& mesh)
    { return solving(heldEnds(mesh, 3, Weights::Clamped), fewCycles()); },
    .hasCheckpoints = true },
  { .name = "SolveForOneColumn",
    .on = [](StreamMesh& mesh)
    { return solving(heldEnds(mesh, 1, Weights::Cotangent), fewCycles()); },
    .hasWindow = true,
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "SolveWithUniformWeights",
    .on = [](StreamMesh& mesh)
    { return solving(heldEnds(mesh, 5, Weights::Uniform), fewCycles(3, {}, 1)); },
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "SolveWithoutConstraint",
    .on = [](StreamMesh& mesh) { return solving(freeProblem(mesh), fewCycles()); },
    .hasCheckpoints = true },
  { .name = "SolveWithAllData",
    .on = [](StreamMesh& mesh) { return solving(problemOfAllData(mesh), fewCycles(3, {}, 3)); },
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "SolveByConjugateGradients",
    .on =
      [](StreamMesh& mesh)
    {
      return solving(
        heldEnds(mesh, 3, Weights::Clamped), fewCycles(7, AccelerationKind::ConjugateGradients, 1));
    },
    .hasCheckpoints = true },
  { .name = "SolveByChebyshevPolynomials",
    .on =
      [](StreamMesh& mesh)
    {
      return solving(
        heldEnds(mesh, 1, Weights::Clamped), fewCycles(7, AccelerationKind::Chebyshev, 1));
    },
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "SolveDescribedProblem", .on = describedProblem, .hasCheckpoints = true },
  { .name = "Deform",
    .on = [](StreamMesh& mesh) { return deforming(mesh, withCycles(2)); },
    .hasWindow = true,
    .hasCheckpoints = true },
  { .name = "DeformWithUniformWeights",
    .on = [](StreamMesh& mesh) { return deforming(mesh, withCycles(3, Weights::Uniform)); },
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "DeformToATolerance",
    .on = [](StreamMesh& mesh) { return deforming(mesh, byTolerance(1e-5)); },
    .hasCheckpoints = true,
    .isVariant = true },
  { .name = "Smooth",
    .on = [](StreamMesh&) { return smoothing(std::nullopt); },
    .ofSolids = false },
  { .name = "SmoothAndKeepEdges",
    .on = [](StreamMesh&) { return smoothing(30.0); },
    .ofSolids = false,
    .isVariant = true },
  { .name = "SmoothAColumn",
    .on =
      [](StreamMesh& mesh)
    {
      addColumn<float>(mesh, "signal", { recordedSignal, smoothSignal });
      return smoothing(std::nullopt, "signal");
    } },
  { .name = "Blend", .on = [](StreamMesh& mesh) { return blending(mesh, SeamGradient::Zero); } },
  { .name = "BlendWithAverages",
    .on = [](StreamMesh& mesh) { return blending(mesh, SeamGradient::Average); },
    .isVariant = true },
  { .name = "Area",
    .on = [](StreamMesh&) { return sharing(AreaShare::Equal); },
    .hasWindow = true,
    .refusesBeforeItReads = false,
    .largestStep = 0.5 },
  { .name = "VoronoiAreas",
    .on = [](StreamMesh&) { return sharing(AreaShare::Voronoi); },
    .ofSolids = false,
    .hasWindow = true,
    .refusesBeforeItReads = false,
    .largestStep = 0.5,
    .isVariant = true },
  { .name = "Distance",
    .on = [](StreamMesh& mesh) { return measuring(mesh, false); },
    .inCore = false,
    .largestStep = 0.4 },
  { .name = "DistanceInChunks",
    .on = [](StreamMesh& mesh) { return measuringInChunks(mesh); },
    .inCore = false,
    .hasWindow = true,
    .isVariant = true },
  { .name = "WallDistance",
    .on = [](StreamMesh& mesh) { return measuring(mesh, true); },
    .ofSurfaces = false,
    .inCore = false,
    .hasScratchFiles = false,
    .refusesBeforeItReads = false },
};

/** The jobs of which this is true. */
inline std::vector<Job> jobsWith(bool (*is)(const Job& job))
{
  std::vector<Job> jobs;
  std::ranges::copy_if(AllJobs, std::back_inserter(jobs), is);
  return jobs;
}

inline std::vector<Job> kindsOfJobs()
{
  return jobsWith([](const Job& job) { return !job.isVariant; });
}

/** A test of one of the jobs. */
class JobTest : public ::testing::TestWithParam<Job>
{
protected:
  const Job& job() const { return this->GetParam(); }
};

inline std::ostream& operator<<(std::ostream& out, const Job& job)
{
  return out << job.name;
}

inline std::string nameOf(const ::testing::TestParamInfo<Job>& job)
{
  return job.param.name;
}

} // namespace smg::testing
