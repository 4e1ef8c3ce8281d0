// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/Tasks/SolveSummary.h"
#include "IO/Vtk/PieceInput.h"
#include "smg/Solve.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkMultiProcessController;

namespace smg
{

/** Gives all processes access to a solution in process 0. All methods are collective. With one
 * process, or without a controller, nothing is sent. */
class SolutionExchange
{
public:
  explicit SolutionExchange(vtkMultiProcessController* controller);

  bool isParallel() const { return this->Processes > 1; }
  /** Whether this process has the solution. */
  bool isServer() const { return this->Rank == 0; }

  /** Runs work that may fail in some of the processes; a failure throws Error in all of them. */
  void together(const std::function<void()>& work);

  /** Returns the argument of process 0 in all processes. */
  bool decide(bool answer);

  /** Whether the argument is true in all processes. */
  bool areAll(bool answer);

  /** The first process in which the argument is true; 0: in none. */
  int firstOf(bool answer);

  /** Sends the summary of a process to all processes. */
  void share(SolveSummary& summary, int from = 0);

  /** The values of the vertices `ids` of this process, `columns` each. `solution` is used in
   * process 0 only. Throws Error in the process whose values could not be read. */
  std::vector<double> values(const std::vector<std::int64_t>& ids, int columns, Solution* solution);

private:
  void serve(Solution& solution, int process);
  void ask(const std::vector<std::int64_t>& ids, int columns, std::vector<double>& values);
  void shareText(std::string& text, int from);

  vtkMultiProcessController* Controller;
  int Processes = 1;
  int Rank = 0;
};

/** The last request that all processes have answered together. Process 0, if it is asked for the
 * same once more, does not wait for the others. */
class SharedRequest
{
public:
  /**
   * Whether a request is to be answered together with the other processes. Throws Error if it is
   * streamed and this process is no server, as only process 0 streams.
   */
  bool isShared(const PieceRequest& request, const InputStamp& stamp, bool isServer);

  /** Says that it has been answered, as far as it is not streamed. */
  void noteAnswer(const PieceRequest& request, const InputStamp& stamp);

private:
  /** A request, with what its answer depends on. */
  struct Answered
  {
    InputStamp stamp;
    int piece = 0, pieces = 0;
    bool operator==(const Answered&) const = default;
  };

  std::optional<Answered> Last; ///< that all processes answered together
  /**
   * Whether requests have been streamed since then. They put other pieces in its place in process 0
   * only, which may be asked for the same once more, alone.
   */
  bool HasStreamed = false;
};

/** Updates the input to a requested piece. Throws InputFailed. */
inline vtkSmartPointer<vtkPointSet> fetchPiece(
  PieceInput& input, const PieceRequest& request, const SolutionExchange& exchange)
{
  vtkSmartPointer<vtkPointSet> piece = vtkPointSet::SafeDownCast(request.update(input));
  if (!exchange.isParallel())
  {
    return piece;
  }
  // Process 0 will request other pieces, and a repeated request for this one may need all
  // processes.
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(piece->NewInstance());
  copy->ShallowCopy(piece);
  return copy;
}

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
