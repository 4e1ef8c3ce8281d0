// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/LinearRows.h"

#include <algorithm>
#include <array>
#include <cmath>

// All of it in double precision and in the order of the entries, so that the bits depend on the row
// alone. Positions are differences from that of the node before anything is multiplied.

namespace smg
{
namespace
{

using Vector3 = std::array<double, 3>;

/** A row of P as the fit sees it. */
struct LinearFit
{
  int size = 0;
  double entry[RelaxedRow::Most];
  double slack[RelaxedRow::Most];
  Vector3 from[RelaxedRow::Most]; ///< B: centred, in units of d
  Vector3 lacking{};              ///< -sum of p_c b_c
  /** The lower triangle of B^T D B. */
  double matrix[3][3] = {};
};

/** Whether the C-points of the row are not all in the place of the node. */
bool begin(const CoarseningData& data, std::int64_t i, const RelaxedRow& row, LinearFit& fit)
{
  const float* own = data.fine.point(i);
  double farthest = 0.0;
  fit.size = row.size;
  for (int k = 0; k < fit.size; ++k)
  {
    const std::int64_t coarse = data.publishedCoarse + row.entry[k].offset(data.publishedCoarse);
    const float* point = data.coarsePoint.at(coarse);
    double square = 0.0;
    for (std::size_t x = 0; x < 3; ++x)
    {
      fit.from[k][x] = static_cast<double>(point[x]) - static_cast<double>(own[x]);
      square += fit.from[k][x] * fit.from[k][x];
    }
    farthest = std::max(farthest, square);
    fit.entry[k] = static_cast<double>(row.entry[k].value());
    fit.slack[k] = std::fabs(fit.entry[k]) + LinearRows::Slack;
  }
  if (!(farthest > 0.0))
  {
    return false;
  }
  const double unit = 1.0 / std::sqrt(farthest);
  double total = 0.0;
  Vector3 mean{};
  for (int k = 0; k < fit.size; ++k)
  {
    total += fit.slack[k];
    for (std::size_t x = 0; x < 3; ++x)
    {
      fit.from[k][x] *= unit;
      mean[x] += fit.slack[k] * fit.from[k][x];
      fit.lacking[x] -= fit.entry[k] * fit.from[k][x];
    }
  }
  for (int k = 0; k < fit.size; ++k)
  {
    for (std::size_t x = 0; x < 3; ++x)
    {
      fit.from[k][x] -= mean[x] / total;
      for (std::size_t y = 0; y <= x; ++y)
      {
        fit.matrix[x][y] += fit.slack[k] * fit.from[k][x] * fit.from[k][y];
      }
    }
  }
  return true;
}

/** y of (B^T D B + square) y = lacking, by the factors L D L^T: the matrix is positive definite. */
Vector3 solve(const LinearFit& fit, double square)
{
  double lower[3][3] = {};
  Vector3 pivot{}, y = fit.lacking;
  for (std::size_t a = 0; a < 3; ++a)
  {
    pivot[a] = fit.matrix[a][a] + square;
    for (std::size_t b = 0; b < a; ++b)
    {
      double sum = fit.matrix[a][b];
      for (std::size_t k = 0; k < b; ++k)
      {
        sum -= lower[a][k] * lower[b][k] * pivot[k];
      }
      lower[a][b] = sum / pivot[b];
      pivot[a] -= sum * lower[a][b];
      y[a] -= lower[a][b] * y[b];
    }
  }
  for (std::size_t a = 3; a-- > 0;)
  {
    y[a] /= pivot[a];
    for (std::size_t b = a + 1; b < 3; ++b)
    {
      y[a] -= lower[b][a] * y[b];
    }
  }
  return y;
}

} // namespace

void LinearRows::fit(const CoarseningData& data, std::int64_t i, RelaxedRow& row)
{
  // Next to constraints a row has another sum, and functions vanish there rather than being linear.
  LinearFit fit;
  if (row.size < 2 || row.sum != 1.0F || !begin(data, i, row, fit))
  {
    return;
  }
  for (const double tolerance : { Exact, Loose })
  {
    const Vector3 y = solve(fit, tolerance * tolerance);
    double fitted[RelaxedRow::Most];
    bool fits = true;
    for (int k = 0; k < fit.size; ++k)
    {
      const Vector3& from = fit.from[k];
      fitted[k] = fit.entry[k] + fit.slack[k] * (from[0] * y[0] + from[1] * y[1] + from[2] * y[2]);
      fits = fits && fitted[k] >= Least && fitted[k] <= Most;
    }
    if (fits)
    {
      for (int k = 0; k < fit.size; ++k)
      {
        row.entry[k].setValue(static_cast<float>(fitted[k]));
      }
      return;
    }
  }
}

} // namespace smg
