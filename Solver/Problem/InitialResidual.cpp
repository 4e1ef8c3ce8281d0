// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/InitialResidual.h"

namespace smg
{

std::span<const double> InitialResidual::add(
  const AssembledRow& row, std::span<const double> b, double share)
{
  const std::int64_t i = row.vertex;
  const double* x = this->Values.at(i);
  double squares = 0.0, termSquares = 0.0;
  for (std::size_t k = 0; k < b.size(); ++k)
  {
    double sum = b[k] - row.diagonal * x[k];
    for (std::size_t e = 0; e < row.entries.size(); ++e)
    {
      const double weight =
        row.precise.empty() ? static_cast<double>(row.entries[e].weight()) : row.precise[e];
      sum += weight * this->Values.at(i + row.entries[e].delta())[k];
    }
    this->OfRow[k] = sum;
    squares += sum * sum;
    termSquares += b[k] * b[k] + row.diagonal * row.diagonal * x[k] * x[k];
  }
  this->Squares += share * share * squares;
  this->TermSquares += termSquares;
  return this->OfRow;
}

} // namespace smg
