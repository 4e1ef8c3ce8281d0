// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectDeformation.h"

#include "Testing/Support/ArrayHandles.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/EdgeWeights.h"
#include "Testing/Support/MemorySource.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace smg::testing
{
namespace
{

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const RowMajor> rows(const std::vector<double>& values, Eigen::Index columns)
{
  return { values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns };
}

/** The handles at all vertices. */
VertexHandles allHandles(const StreamMesh& mesh, Handles& handles)
{
  MeshBlock whole;
  whole.positions = mesh.positions;
  whole.corners = mesh.corners;
  whole.vertexColumns = mesh.vertexColumns;
  whole.cellColumns = mesh.cellColumns;
  whole.finalized = mesh.vertices();
  VertexHandles all;
  all.clear(mesh.vertices());
  handles.at(whole, all);
  return all;
}

/** In a deformation, flat cells connect their corners. */
class StepProblem : public ArrayProblem
{
public:
  bool connectsFlatCells() const override { return true; }
};

/**
 * Step 1: the rotation vectors and log scales of the handles; zero on components without handles.
 */
StepProblem fieldProblem(const VertexHandles& handles, Weights weights)
{
  StepProblem problem;
  problem.Columns = 4;
  problem.EdgeWeights = weights;
  problem.Value.assign(4 * handles.mask.size(), 0.0);
  for (std::size_t v = 0; v < handles.mask.size(); ++v)
  {
    problem.Prescribed.push_back(handles.mask[v] > 0);
    if (handles.mask[v] > 0)
    {
      std::copy_n(handles.rotation.begin() + 3 * v, 3, problem.Value.begin() + 4 * v);
      problem.Value[4 * v + 3] = handles.logScale[v];
    }
  }
  return problem;
}

/** Step 2: the positions whose edges are closest to the transformed ones. */
class PositionProblem : public StepProblem
{
public:
  PositionProblem(const StreamMesh& mesh, const VertexHandles& handles,
    const DirectDeformation& stepOne, Weights weights)
  {
    this->Columns = 3;
    this->EdgeWeights = weights;
    this->Value = mesh.positions;
    for (std::size_t v = 0; v < handles.mask.size(); ++v)
    {
      this->Prescribed.push_back(handles.mask[v] > 0);
      if (handles.mask[v] > 0)
      {
        std::copy_n(handles.target.begin() + 3 * v, 3, this->Value.begin() + 3 * v);
      }
      this->Transforms.push_back(stepOne.transformOf(static_cast<Eigen::Index>(v)));
    }
  }

  bool hasEdgeTargets() const override { return true; }
  void edgeTargets(EdgeBatch& batch) override
  {
    using Point = Eigen::Map<const Eigen::Vector3d>;
    for (std::size_t e = 0; e < batch.from.size(); ++e)
    {
      const Eigen::Vector3d edge = Point(&batch.fromPoint[3 * e]) - Point(&batch.toPoint[3 * e]);
      const Eigen::Matrix3d transform =
        0.5 * (this->Transforms[batch.from[e]] + this->Transforms[batch.to[e]]);
      Eigen::Vector3d::Map(&batch.target[3 * e]) = transform * edge;
    }
  }

private:
  std::vector<Eigen::Matrix3d> Transforms;
};

DirectSystem assembled(const StreamMesh& mesh, Problem& problem)
{
  MemorySource source(mesh);
  return assembleDirect(source, problem);
}

/** The weights of the edges. */
std::vector<EdgeWeight> edgesOf(const StreamMesh& mesh, Weights weights)
{
  MemorySource source(mesh);
  EdgeWeights sums(source.info(), weights, true);
  MeshBlock block;
  while (source.next(block))
  {
    sums.add(block, mesh.positions);
  }
  sums.finish(mesh.positions);
  return sums.edges();
}

/** sum_j w_ij (x_i - x_j) of every vertex. */
Eigen::MatrixXd laplacianVectors(const std::vector<EdgeWeight>& edges, const Eigen::MatrixXd& x)
{
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(x.rows(), 3);
  for (const EdgeWeight& edge : edges)
  {
    const Eigen::RowVector3d pull = edge.weight * (x.row(edge.from) - x.row(edge.to));
    vectors.row(edge.from) += pull;
    vectors.row(edge.to) -= pull;
  }
  return vectors;
}

} // namespace

Eigen::Matrix3d DirectDeformation::transformOf(Eigen::Index vertex) const
{
  return std::exp(this->fields(vertex, 3)) *
         rotationMatrix(this->fields.row(vertex).head<3>().transpose());
}

DirectDeformation deformDirectly(const StreamMesh& mesh, Handles& handles, Weights weights)
{
  const VertexHandles all = allHandles(mesh, handles);
  DirectDeformation result;
  StepProblem fields = fieldProblem(all, weights);
  result.fields = solveDirect(assembled(mesh, fields));

  PositionProblem positions(mesh, all, result, weights);
  const DirectSystem system = assembled(mesh, positions);
  result.positions = solveDirect(system);
  // A component without handles is unchanged, bit for bit.
  for (Eigen::Index i = 0; i < system.unknowns(); ++i)
  {
    if (system.isFloating[system.component[i]])
    {
      const std::int64_t v = system.freeVertices[i];
      result.positions.row(v) = rows(mesh.positions, 3).row(v);
    }
  }
  return result;
}

double deformationError(const StreamMesh& mesh, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  const auto points = rows(mesh.positions, 3);
  const double diagonal = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  return (a - b).rowwise().norm().maxCoeff() / diagonal;
}

std::vector<double> detailAngles(const StreamMesh& mesh, const VertexHandles& handles,
  const DirectDeformation& direct, const Eigen::MatrixXd& positions, Weights weights)
{
  const std::vector<EdgeWeight> edges = edgesOf(mesh, weights);
  const Eigen::MatrixXd rest = laplacianVectors(edges, rows(mesh.positions, 3));
  const Eigen::MatrixXd actual = laplacianVectors(edges, positions);
  std::vector<double> angles;
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
  {
    const Eigen::Vector3d expected = direct.transformOf(v) * rest.row(v).transpose();
    const Eigen::Vector3d found = actual.row(v).transpose();
    if (handles.mask[v] == 0 && expected.norm() > 0.0 && found.norm() > 0.0)
    {
      const double angle = std::atan2(expected.cross(found).norm(), expected.dot(found));
      angles.push_back(angle * 180.0 / std::numbers::pi);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

} // namespace smg::testing
