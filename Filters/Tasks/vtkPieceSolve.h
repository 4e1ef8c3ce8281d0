// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkInputStamp.h"
#include "Filters/Pieces/vtkPieceRequest.h"
#include "Filters/Tasks/SolveSummary.h"

#include <utility>
#include <vector>

namespace smg
{

/** The solution at the points of one piece, kept with the request and the stamp of its input. */
class PieceSolve
{
public:
  bool isEmpty() const { return this->Summary.report.empty(); }
  /** Whether there is a solution for this. */
  bool isFor(const PieceRequest& request, const InputStamp& stamp) const
  {
    return !this->isEmpty() && this->Piece == request.Piece && this->Pieces == request.Pieces &&
           this->MadeFor == stamp;
  }

  /** Keeps the values at the points of a piece. */
  void hold(const SolveSummary& summary, std::vector<double> values)
  {
    this->Summary = summary;
    this->Values = std::move(values);
  }

  /** Sets what the solution is for. */
  void setStamp(const PieceRequest& request, const InputStamp& stamp)
  {
    this->Piece = request.Piece;
    this->Pieces = request.Pieces;
    this->MadeFor = stamp;
  }

  void release() { *this = {}; }

  const std::vector<double>& values() const { return this->Values; }
  const SolveSummary& summary() const { return this->Summary; }

private:
  SolveSummary Summary; ///< without a report: there is no solution
  std::vector<double> Values;
  int Piece = 0, Pieces = 0;
  InputStamp MadeFor;
};

} // namespace smg
