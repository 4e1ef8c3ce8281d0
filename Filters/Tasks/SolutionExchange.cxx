// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolutionExchange.h"

#include "Filters/Tasks/SolveSummary.h"
#include "Solver/Core/ReportFields.h"
#include "smg/Error.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <exception>

namespace smg
{

namespace
{

/** Message tags, arbitrary numbers that VTK's own messages do not use. */
enum Tag
{
  CountTag = 735101,
  IdsTag,
  StatusTag,
  ValuesTag
};

/** The maximum number of vertices per message, to bound the memory on both sides. */
constexpr std::size_t MessageIds = 65536;

} // namespace

SolutionExchange::SolutionExchange(vtkMultiProcessController* controller)
  : Controller(controller)
{
  if (controller)
  {
    this->Processes = controller->GetNumberOfProcesses();
    this->Rank = controller->GetLocalProcessId();
  }
}

void SolutionExchange::shareText(std::string& text, int from)
{
  vtkIdType length = static_cast<vtkIdType>(text.size());
  this->Controller->Broadcast(&length, 1, from);
  text.resize(length);
  if (length > 0)
  {
    this->Controller->Broadcast(text.data(), length, from);
  }
}

void SolutionExchange::together(const std::function<void()>& work)
{
  std::exception_ptr failure;
  try
  {
    work();
  }
  catch (const std::exception&)
  {
    failure = std::current_exception();
  }
  const int hasFailed = failure ? 1 : 0;
  int hasAnyFailed = hasFailed;
  if (this->isParallel())
  {
    this->Controller->AllReduce(&hasFailed, &hasAnyFailed, 1, vtkCommunicator::MAX_OP);
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  if (hasAnyFailed)
  {
    throw Error("Another process failed, and with it this one: see the error that it reported.");
  }
}

bool SolutionExchange::decide(bool answer)
{
  int word = answer ? 1 : 0;
  if (this->isParallel())
  {
    this->Controller->Broadcast(&word, 1, 0);
  }
  return word != 0;
}

bool SolutionExchange::areAll(bool answer)
{
  const int word = answer ? 1 : 0;
  int least = word;
  if (this->isParallel())
  {
    this->Controller->AllReduce(&word, &least, 1, vtkCommunicator::MIN_OP);
  }
  return least != 0;
}

int SolutionExchange::firstOf(bool answer)
{
  const int process = answer ? this->Rank : this->Processes;
  int first = process;
  if (this->isParallel())
  {
    this->Controller->AllReduce(&process, &first, 1, vtkCommunicator::MIN_OP);
  }
  return first < this->Processes ? first : 0;
}

void SolutionExchange::share(SolveSummary& summary, int from)
{
  if (!this->isParallel())
  {
    return;
  }
  this->shareText(summary.error, from);
  this->shareText(summary.report, from);
  this->shareText(summary.notes, from);
  this->shareText(summary.previewError, from);
  std::string facts;
  if (this->Rank == from)
  {
    // Tables, outputs and warnings of a solve are there once.
    Report shared = summary.facts;
    clearLists(shared);
    shared.warnings.clear();
    const std::vector<std::uint8_t> bytes = packedReport(shared);
    facts.assign(bytes.begin(), bytes.end());
  }
  this->shareText(facts, from);
  vtkIdType numbers[] = { summary.columns, summary.isCancelled, summary.previewPoints,
    summary.fullPoints };
  this->Controller->Broadcast(numbers, 4, from);
  if (this->Rank != from)
  {
    summary.facts = unpackedReport(std::vector<std::uint8_t>(facts.begin(), facts.end()));
  }
  summary.columns = static_cast<int>(numbers[0]);
  summary.isCancelled = numbers[1] != 0;
  summary.previewPoints = numbers[2];
  summary.fullPoints = numbers[3];
}

std::vector<double> SolutionExchange::values(
  const std::vector<std::int64_t>& ids, int columns, Solution* solution)
{
  std::vector<double> values(ids.size() * columns);
  if (!this->isServer())
  {
    this->ask(ids, columns, values);
    return values;
  }
  for (int process = 1; process < this->Processes; ++process)
  {
    this->serve(*solution, process);
  }
  readValues(*solution, ids, values);
  return values;
}

void SolutionExchange::ask(
  const std::vector<std::int64_t>& ids, int columns, std::vector<double>& values)
{
  bool isComplete = true;
  std::vector<vtkIdType> message;
  for (std::size_t begin = 0;; begin += MessageIds)
  {
    const std::size_t end = std::min(begin + MessageIds, ids.size());
    vtkIdType count = begin < end ? static_cast<vtkIdType>(end - begin) : 0;
    this->Controller->Send(&count, 1, 0, CountTag);
    if (count == 0)
    {
      break;
    }
    message.assign(ids.begin() + begin, ids.begin() + end);
    this->Controller->Send(message.data(), count, 0, IdsTag);
    int status = 0;
    this->Controller->Receive(&status, 1, 0, StatusTag);
    if (status)
    {
      this->Controller->Receive(values.data() + begin * columns, count * columns, 0, ValuesTag);
    }
    isComplete = isComplete && status;
  }
  if (!isComplete)
  {
    throw Error("Process 0 could not read the solution for the points of process " +
                std::to_string(this->Rank) +
                ": look at its GlobalIds and at the scratch folder of process 0.");
  }
}

void SolutionExchange::serve(Solution& solution, int process)
{
  std::vector<vtkIdType> message;
  std::vector<std::int64_t> ids;
  std::vector<double> values;
  for (;;)
  {
    vtkIdType count = 0;
    this->Controller->Receive(&count, 1, process, CountTag);
    if (count <= 0)
    {
      return;
    }
    message.resize(count);
    this->Controller->Receive(message.data(), count, process, IdsTag);
    ids.assign(message.begin(), message.end());
    values.resize(count * solution.columns());
    int status = 1;
    try
    {
      readValues(solution, ids, values);
    }
    catch (const std::exception&)
    {
      // The requesting process reports the error; the others must still be served.
      status = 0;
    }
    this->Controller->Send(&status, 1, process, StatusTag);
    if (status)
    {
      this->Controller->Send(
        values.data(), static_cast<vtkIdType>(values.size()), process, ValuesTag);
    }
  }
}

bool SharedRequest::isShared(const PieceRequest& request, const InputStamp& stamp, bool isServer)
{
  if (request.IsStreamed)
  {
    // The others are not there to answer.
    if (!isServer)
    {
      throw Error("A streamed request reached a process other than 0, which has no solution: "
                  "stream in process 0.");
    }
    this->HasStreamed = true;
    return false;
  }
  if (isServer && this->HasStreamed &&
      this->Last == Answered{ stamp, request.Piece, request.Pieces })
  {
    return false;
  }
  this->HasStreamed = false;
  this->Last.reset();
  return true;
}

void SharedRequest::noteAnswer(const PieceRequest& request, const InputStamp& stamp)
{
  if (!request.IsStreamed)
  {
    this->Last = Answered{ stamp, request.Piece, request.Pieces };
  }
}

} // namespace smg
