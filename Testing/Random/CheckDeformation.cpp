// SPDX-License-Identifier: BSD-3-Clause
// Deformations: two direct solves, and the motion that all handles have in common.
#include "Testing/Random/Evaluation.h"
#include "Testing/Random/JobRuns.h"
#include "Testing/Support/DirectDeformation.h"
#include "Testing/Support/MemorySource.h"
#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescriptionFiles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using nlohmann::json;

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
  const Shapes shapes(given);
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
  // Clamped weights are in single precision, which weighs as much as needles are long.
  if (to.error > (isWellShaped(given) ? 1e-5 : 1e-3))
  {
    to.failure = "differs from the direct deformation by " + std::to_string(to.error);
    return;
  }
  checkCommonMotion(given, found.values, to);
}

} // namespace smg::testing
