// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/InitialResidual.h"

#include "Solver/Core/Padding.h"

namespace smg
{

std::span<const double> InitialResidual::add(
  const AssembledRow& row, std::span<const double> b, double share)
{
  const std::int64_t i = row.vertex;
  const double* x = this->Values.at(i);
  double squares = 0.0, termSquares = 0.0;
  withColumns(static_cast<int>(b.size()),
    [&](auto columns)
    {
      double* sum = this->OfRow.data();
      for (int k = 0; k < columns; ++k)
      {
        sum[k] = b[static_cast<std::size_t>(k)] - row.diagonal * x[k];
      }
      for (std::size_t e = 0; e < row.weights.size(); ++e)
      {
        const double* other = x + std::ptrdiff_t(columns) * row.entries[e].delta();
        for (int k = 0; k < columns; ++k)
        {
          sum[k] += row.weights[e] * other[k];
        }
      }
      for (int k = 0; k < columns; ++k)
      {
        const double own = b[static_cast<std::size_t>(k)];
        squares += sum[k] * sum[k];
        termSquares += own * own + row.diagonal * row.diagonal * x[k] * x[k];
      }
    });
  this->Squares += share * share * squares;
  this->TermSquares += termSquares;
  return this->OfRow;
}

} // namespace smg
