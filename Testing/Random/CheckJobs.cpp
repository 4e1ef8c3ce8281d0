// SPDX-License-Identifier: BSD-3-Clause
// Oracles of the jobs that are made of solves. A step of smoothing and a blend are elliptic
// problems: they are written as such for the oracle of solves.
#include "Testing/Random/Check.h"

#include "Testing/Random/Doors.h"
#include "Testing/Random/Evaluation.h"
#include "Testing/Support/DirectDeformation.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Blend.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescriptionFiles.h"
#include "smg/Smooth.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using nlohmann::json;

/** The result of a job as told, which has the bits of the plain run. */
Result sameAsPlain(
  const Case& given, const std::function<Result(const CaseRun&)>& run, CheckedCase& to)
{
  const Result expected = run(plain(given.run));
  Result found = run(given.run);
  if (!sameBits(found.values, expected.values))
  {
    to.failure = "does not have the bits of the plain run";
  }
  to.hasConverged = found.report.converged;
  return found;
}

template <class Options>
Options optionsOf(const CaseRun& run, const TemporaryFolder& folder)
{
  Options options;
  setOptions(run, options);
  options.scratch = folder.path();
  return options;
}

MatrixXd rowsOf(const std::vector<double>& values, int columns)
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), std::ssize(values) / columns, columns);
}

std::vector<double> listOf(const MatrixXd& rows)
{
  std::vector<double> values;
  for (Eigen::Index v = 0; v < rows.rows(); ++v)
  {
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
    {
      values.push_back(rows(v, k));
    }
  }
  return values;
}

Vector3d vectorOf(const json& numbers)
{
  const auto list = numbers.get<std::vector<double>>();
  return Vector3d(list.at(0), list.at(1), list.at(2));
}

/** The motion of a handle, in words of its own. */
struct Motion
{
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vector3d center = Vector3d::Zero(), translation = Vector3d::Zero(), rotation = Vector3d::Zero();
  double logScale = 0.0;

  explicit Motion(const json& handle)
  {
    double scale = 1.0;
    if (handle.contains("rotate"))
    {
      const json& rotate = handle.at("rotate");
      const Vector3d axis = vectorOf(rotate.at("axis")).normalized();
      const double angle = rotate.at("degrees").get<double>() * std::numbers::pi / 180.0;
      this->linear = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      this->rotation = angle * axis;
    }
    if (handle.contains("scale"))
    {
      scale = handle.at("scale");
      this->logScale = std::log(scale);
    }
    this->linear *= scale;
    if (handle.contains("center"))
    {
      this->center = vectorOf(handle.at("center"));
    }
    if (handle.contains("translate"))
    {
      this->translation = vectorOf(handle.at("translate"));
    }
    if (handle.contains("target"))
    {
      this->rotation = vectorOf(handle.at("rotation"));
      this->logScale = handle.at("logScale");
    }
  }

  Vector3d apply(const Vector3d& p) const
  {
    return this->center + this->linear * (p - this->center) + this->translation;
  }
};

/** The handles of a case on the whole mesh. */
class CaseHandles : public Handles
{
public:
  explicit CaseHandles(const Case& given)
    : On(given)
  {
  }

  void at(const MeshBlock&, VertexHandles& handles) override
  {
    const Evaluation at(this->On);
    bool isEmpty = false;
    for (const json& handle : this->On.problem.at("handles"))
    {
      const std::vector<bool> held = at.select(handle.at("region"), Of::Vertices, isEmpty);
      const Motion motion(handle);
      for (std::size_t v = 0; v < held.size(); ++v)
      {
        if (!held[v])
        {
          continue;
        }
        const Vector3d p = at.point(static_cast<std::int64_t>(v));
        const bool isPlace = handle.contains("target") && handle.at("target") != "position";
        const Vector3d target = isPlace ? vectorOf(handle.at("target")) : motion.apply(p);
        handles.mask[v] = 1;
        Vector3d::Map(&handles.target[3 * v]) = target;
        Vector3d::Map(&handles.rotation[3 * v]) = motion.rotation;
        handles.logScale[v] = motion.logScale;
      }
    }
  }

private:
  const Case& On;
};

/** All vertices follow handles that all move alike by a similarity. */
void checkCommonMotion(const Case& given, const MatrixXd& positions, CheckedCase& to)
{
  const json& handles = given.problem.at("handles");
  const auto motionOf = [](json handle)
  {
    handle.erase("region");
    return handle;
  };
  if (handles[0].contains("target") || std::ranges::any_of(handles, [&](const json& handle)
                                         { return motionOf(handle) != motionOf(handles[0]); }))
  {
    return;
  }
  const Motion motion(handles[0]);
  const MatrixXd rest = rowsOf(given.points, 3);
  double size = 0.0, largest = 0.0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
  {
    const Vector3d p = rest.row(v), moved = motion.apply(p), found = positions.row(v);
    size = std::max({ size, p.norm(), moved.norm() });
    // Bodies without a handle stay.
    const double stays = (found - p).norm() == 0.0 ? 0.0 : INFINITY;
    largest = std::max(largest, std::min(stays, (found - moved).norm()));
  }
  if (largest > 1e-5 * size)
  {
    to.failure = "is not moved by the motion that all handles have";
  }
}

/** Whether finite-element weights of all cells are of ordinary size: cells are no needles. */
bool isWellShaped(const Case& given)
{
  const int size = cornersOf(given.type);
  const MatrixXd points = rowsOf(given.points, 3);
  const Oracle shapes(
    [&]
    {
      Case bare = given;
      bare.job = "solve";
      bare.problem = { { "columns", 1 }, { "source", { 0.0 } } };
      return bare;
    }());
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    const MatrixXd& gradients = shapes.gradients[static_cast<std::size_t>(c)];
    double longest = 0.0;
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        longest =
          std::max(longest, (points.row(given.cell(c)[i]) - points.row(given.cell(c)[j])).norm());
      }
    }
    if (gradients.size() > 0 && longest * gradients.rowwise().norm().maxCoeff() > 1e3)
    {
      return false;
    }
  }
  return true;
}

/** A case of the elliptic problem -div(grad u - q) + s u = f for the oracle. */
Case asSolve(const Case& given, const MatrixXd& values, const json& hold)
{
  Case solve = given;
  solve.job = "solve";
  solve.vertexColumns.push_back(
    { "#values", static_cast<int>(values.cols()), listOf(values), false });
  solve.problem = { { "columns", values.cols() }, { "initial", "#values" } };
  for (json place : hold)
  {
    place["value"] = "#values";
    solve.problem["dirichlet"].push_back(place);
  }
  return solve;
}

/** The measures of the cells of a moved mesh, lumped; cells that had none still have none. */
VectorXd massOf(const Case& given, const MatrixXd& points)
{
  const std::vector<std::uint8_t> flags = given.flags();
  const int size = cornersOf(given.type);
  VectorXd mass = VectorXd::Zero(given.vertices());
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    const std::int64_t* corner = given.cell(c);
    const auto edge = [&](int k) -> Vector3d
    { return points.row(corner[k]) - points.row(corner[0]); };
    const double measure = flags[static_cast<std::size_t>(c)] != 0 ? 0.0
                           : size == 3 ? edge(1).cross(edge(2)).norm() / 2
                                       : std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6;
    for (int k = 0; k < size; ++k)
    {
      mass[corner[k]] += measure / size;
    }
  }
  return mass;
}

} // namespace

void checkDeformation(const Case& given, CheckedCase& to)
{
  const DeformationDescription description = readHandleText(given.problem.dump(), "handles");
  const TemporaryFolder folder;
  const Result found = sameAsPlain(
    given,
    [&](const CaseRun& run)
    {
      MemorySource source(given.stream(), run.blockCells);
      DescribedHandles handles(description, source.info());
      handles.prepare(source, folder.path());
      source.rewind(run.blockCells);
      auto options = optionsOf<DeformOptions>(run, folder);
      description.applyTo(options);
      const std::unique_ptr<Solution> solution = deform(source, handles, options);
      return Result{ valuesOf(*solution), solution->report() };
    },
    to);
  if (!to.failure.empty() || !to.hasConverged)
  {
    return;
  }
  if (!found.values.allFinite())
  {
    to.failure = "a position is not a number";
    return;
  }
  const bool isCotangent = given.problem.value("weights", "") == "cotangent";
  if (isCotangent && !isWellShaped(given))
  {
    return; // equations of bad condition
  }
  const StreamMesh mesh = given.stream();
  CaseHandles handles(given);
  const DirectDeformation direct = deformDirectly(mesh, handles,
    isCotangent                                              ? Weights::Cotangent
    : given.problem.value("weights", "clamped") == "clamped" ? Weights::Clamped
                                                             : Weights::Uniform);
  // Handles may move all vertices to one place.
  const MatrixXd rest = rowsOf(given.points, 3);
  const auto diagonal = [](const MatrixXd& points)
  { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); };
  const double extent = std::max(diagonal(direct.positions), diagonal(rest));
  to.error = (found.values - direct.positions).rowwise().norm().maxCoeff() / extent;
  if (to.error > (isWellShaped(given) ? 1e-5 : 1e-4))
  {
    to.failure = "differs from the direct deformation by " + std::to_string(to.error);
    return;
  }
  checkCommonMotion(given, found.values, to);
}

void checkSmoothing(const Case& given, CheckedCase& to)
{
  const json& asked = given.problem;
  const std::string column = asked.at("column");
  const std::string boundary = asked.at("boundary");
  const double size = asked.at("size");
  const int steps = asked.at("steps");
  const TemporaryFolder folder;
  const Result found = sameAsPlain(
    given,
    [&](const CaseRun& run)
    {
      const MemoryMesh mesh(given.stream(), run.blockCells);
      auto options = optionsOf<SmoothingOptions>(run, folder);
      options.size = { size, SmoothingSize::Mesh };
      options.steps = steps;
      options.hold = asked.at("hold").empty() ? std::vector<Where>{}
                                              : readPlacesText(asked.at("hold").dump(), "hold");
      options.boundary = boundary == "smooth"  ? SmoothedBoundary::Smooth
                         : boundary == "fixed" ? SmoothedBoundary::Fixed
                                               : SmoothedBoundary::Free;
      options.keepVolume = asked.at("keepVolume");
      options.column = column;
      const std::unique_ptr<Solution> solution = smooth(mesh, options);
      return Result{ valuesOf(*solution), solution->report() };
    },
    to);
  if (!to.failure.empty() || asked.at("keepVolume") || boundary == "smooth")
  {
    return;
  }
  json hold = asked.at("hold");
  if (boundary == "fixed")
  {
    hold.push_back({ { "boundary", true } });
  }
  const CaseColumn* values = column.empty() ? nullptr : find(given.vertexColumns, column);
  MatrixXd x = values ? rowsOf(values->values, values->components) : rowsOf(given.points, 3);
  const VectorXd rest = massOf(given, rowsOf(given.points, 3));
  const double t = (std::exp2(1.0 / steps) - 1.0) * std::pow(size / (2.0 * std::numbers::pi), 2);
  for (int step = 0; step < steps; ++step)
  {
    // L u + (M / t) u = (M / t) x, with M in units of that of the mesh.
    const VectorXd mass = values ? rest : massOf(given, x);
    const VectorXd reaction = (rest.array() > 0.0).select(mass.array() / rest.array() / t, 0.0);
    Case solve = asSolve(given, x, hold);
    solve.vertexColumns.push_back({ "#reaction", 1, listOf(reaction), false });
    solve.vertexColumns.push_back(
      { "#source", static_cast<int>(x.cols()), listOf(reaction.asDiagonal() * x), false });
    solve.problem["screening"] = "#reaction";
    solve.problem["source"] = "#source";
    const Oracle oracle(solve);
    if (step + 1 == steps)
    {
      compare(solve, oracle, found.values, found.report, to);
    }
    for (Eigen::Index v = 0; v < x.rows(); ++v)
    {
      if (oracle.determined[static_cast<std::size_t>(v)])
      {
        x.row(v) = oracle.solution.row(v);
      }
    }
  }
}

namespace
{

/** The patch of each vertex; none: it has several. */
std::vector<std::optional<double>> patchesOf(const Case& given)
{
  const std::string name = given.problem.at("patch");
  std::vector<std::optional<double>> patches(static_cast<std::size_t>(given.vertices()));
  if (const CaseColumn* column = find(given.vertexColumns, name))
  {
    std::ranges::copy(column->values, patches.begin());
    return patches;
  }
  const CaseColumn& column = *find(given.cellColumns, name);
  std::vector<std::set<double>> of(patches.size());
  for (std::size_t k = 0; k < given.corners.size(); ++k)
  {
    of[static_cast<std::size_t>(given.corners[k])].insert(
      column.values[k / static_cast<std::size_t>(cornersOf(given.type))]);
  }
  for (std::size_t v = 0; v < of.size(); ++v)
  {
    if (of[v].size() == 1)
    {
      patches[v] = *of[v].begin();
    }
  }
  return patches;
}

/** The gradients that a blend aims at: of each cell, three numbers a component. */
std::vector<double> gradientsAimedAt(
  const Case& given, const Oracle& shapes, const MatrixXd& values)
{
  const std::vector<std::optional<double>> patches = patchesOf(given);
  const int size = cornersOf(given.type);
  const auto components = values.cols();
  const bool isAverage = given.problem.at("seam") == "average";
  const auto isInside = [&](std::int64_t c)
  {
    const auto& first = patches[static_cast<std::size_t>(given.cell(c)[0])];
    return first &&
           std::all_of(given.cell(c), given.cell(c) + size,
             [&](std::int64_t v) { return patches[static_cast<std::size_t>(v)] == first; });
  };
  const auto gradientOf = [&](std::int64_t c)
  {
    const MatrixXd& shape = shapes.gradients[static_cast<std::size_t>(c)];
    MatrixXd gradient = MatrixXd::Zero(3, components);
    for (int k = 0; k < shape.rows(); ++k)
    {
      gradient += shape.row(k).transpose() * values.row(given.cell(c)[k]);
    }
    return gradient;
  };
  const MatrixXd points = rowsOf(given.points, 3);
  std::vector<std::pair<double, MatrixXd>> around(
    static_cast<std::size_t>(given.vertices()), { 0.0, MatrixXd::Zero(3, components) });
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    if (!isInside(c) || shapes.gradients[static_cast<std::size_t>(c)].size() == 0)
    {
      continue;
    }
    const auto edge = [&](int k) -> Vector3d
    { return points.row(given.cell(c)[k]) - points.row(given.cell(c)[0]); };
    const double measure =
      size == 3 ? edge(1).cross(edge(2)).norm() : std::abs(edge(1).cross(edge(2)).dot(edge(3)));
    for (int k = 0; k < size; ++k)
    {
      auto& [sum, gradients] = around[static_cast<std::size_t>(given.cell(c)[k])];
      sum += measure;
      gradients += measure * gradientOf(c);
    }
  }
  std::vector<double> aims;
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    MatrixXd aim = MatrixXd::Zero(3, components);
    if (isInside(c))
    {
      aim = gradientOf(c);
    }
    else if (isAverage)
    {
      double sum = 0.0;
      for (int k = 0; k < size; ++k)
      {
        const auto& [measure, gradients] = around[static_cast<std::size_t>(given.cell(c)[k])];
        sum += measure;
        aim += gradients;
      }
      aim /= sum > 0.0 ? sum : 1.0;
    }
    aims.insert(aims.end(), aim.data(), aim.data() + aim.size());
  }
  return aims;
}

} // namespace

void checkBlend(const Case& given, CheckedCase& to)
{
  const json& asked = given.problem;
  BlendDescription description;
  description.patch = asked.at("patch");
  description.columns = asked.at("columns").get<std::vector<std::string>>();
  description.anchor = asked.at("anchor");
  description.seam = asked.at("seam") == "average" ? SeamGradient::Average : SeamGradient::Zero;
  if (!asked.at("hold").empty())
  {
    description.hold = readPlacesText(asked.at("hold").dump(), "hold");
  }
  const TemporaryFolder folder;
  const Result found = sameAsPlain(
    given,
    [&](const CaseRun& run)
    {
      const MemoryMesh mesh(given.stream(), run.blockCells);
      const std::unique_ptr<Solution> solution =
        blend(mesh, description, optionsOf<SolveOptions>(run, folder));
      return Result{ valuesOf(*solution), solution->report() };
    },
    to);
  if (!to.failure.empty())
  {
    return;
  }
  const CaseColumn& column = *find(given.vertexColumns, description.columns.at(0));
  const MatrixXd values = rowsOf(column.values, column.components);
  Case solve = asSolve(given, values, asked.at("hold"));
  const MatrixXd points = rowsOf(given.points, 3);
  const double screening =
    description.anchor / (points.colwise().maxCoeff() - points.colwise().minCoeff()).squaredNorm();
  solve.problem["screening"] = screening;
  solve.vertexColumns.push_back(
    { "#source", column.components, listOf(screening * values), false });
  solve.problem["source"] = "#source";
  solve.cellColumns.push_back(
    { "#aim", 3 * column.components, gradientsAimedAt(given, Oracle(solve), values), false });
  solve.problem["field"] = "#aim";
  compare(solve, Oracle(solve), found.values, found.report, to);
}

} // namespace smg::testing
