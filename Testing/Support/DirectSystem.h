// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Problem.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace smg::testing
{

/**
 * The system A x = b of Problem.h, assembled in double precision from the mesh stream,
 * independently of the solver. The unknowns are the free vertices in stream order.
 *
 * Weights: cotangent, for triangles the sum of cot(angle)/2 over the cells of an edge, at least
 * 5e-4; for tetrahedra the negated off-diagonal entry of the linear finite-element stiffness
 * matrix, at least 1e-4 |p_i - p_j|; uniform: 1. Cells with repeated corners, without area or
 * volume, or with CellFlags have no weight (but see Problem::connectsFlatCells). A vertex without a
 * weighted cell is not an unknown and keeps its value.
 */
struct DirectSystem
{
  Eigen::SparseMatrix<double> matrix;     ///< free x free, symmetric, both halves
  Eigen::MatrixXd rightSide;              ///< free x columns
  Eigen::MatrixXd values;                 ///< vertices x columns: prescribed and initial values
  std::vector<std::int64_t> freeVertices; ///< stream index of each unknown
  Eigen::VectorXd mass;                   ///< lumped area or volume of each vertex of the mesh
  /** The component of each unknown; components are numbered from 0. */
  std::vector<int> component;
  /** Whether each component has neither constrained vertices nor screening. */
  std::vector<std::uint8_t> isFloating;

  std::int64_t degenerateCells = 0;
  std::int64_t clampedWeights = 0;
  std::int64_t prescribed = 0;
  std::int64_t held = 0;

  std::int64_t unknowns() const { return this->rightSide.rows(); }
  /** The initial values of the unknowns. */
  Eigen::MatrixXd initial() const;
  /** The unknowns of a solution at all vertices. */
  Eigen::MatrixXd gather(const Eigen::MatrixXd& allVertices) const;
  /** The solution at all vertices from the unknowns. */
  Eigen::MatrixXd scatter(const Eigen::MatrixXd& unknowns) const;
  /** ||b - A c|| over all columns, for the best constant c of each. */
  double residualOfConstants() const;
  /** ||b - A x|| / ||b - A c|| over all columns, for x at all vertices and the best constant c of
   * each column. For a connected mesh that something holds. */
  double relativeResidual(const Eigen::MatrixXd& allVertices) const;
};

/** Reads the mesh and assembles the system. Requires fewer than 2^31 vertices. */
DirectSystem assembleDirect(MeshSource& mesh, Problem& problem);

} // namespace smg::testing
