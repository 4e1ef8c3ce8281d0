// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/GatheredSolution.h"

#include "Solver/Multigrid/Engine/VertexRange.h"

#include <algorithm>
#include <array>
#include <exception>

namespace smg
{
namespace
{

/** Vertices whose values process 0 wants; none: no more. */
struct Request
{
  std::int64_t first = 0, count = 0;
};

enum Tag
{
  RequestTag = 1,
  ValuesTag
};

/** Values are sent in pieces of this number of vertices. */
constexpr std::int64_t MostVertices = std::int64_t(1) << 20;

/** The values of own vertices, by stream index. */
const double* valuesOf(
  const SharedVertices& vertices, const DistributedSolution& solution, std::int64_t id)
{
  return solution.values.data() + vertices.find(id) * solution.columns;
}

/** The solution on process 0, whose other vertices are asked of their owners. */
class GatheredSolution final : public Solution
{
public:
  GatheredSolution(const SharedVertices& vertices, const DistributedSolution& solution)
    : Vertices(vertices)
    , Part(solution)
  {
  }
  ~GatheredSolution() override
  {
    const Request end;
    for (int p = 1; p < this->Vertices.team().size(); ++p)
    {
      this->send(p, end);
    }
  }

  std::int64_t vertices() const override { return this->Part.report.vertices; }
  int columns() const override { return this->Part.columns; }
  const Report& report() const override { return this->Part.report; }

  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    checkVertexRange(
      first, count, values.size() / static_cast<std::size_t>(this->columns()), this->vertices());
    for (double* to = values.data(); count > 0;)
    {
      const int owner = this->Vertices.ownerOf(first);
      const std::int64_t part =
        std::min({ count, this->Vertices.endOf(owner) - first, MostVertices });
      this->readFrom(owner, { first, part }, to);
      first += part;
      count -= part;
      to += part * this->columns();
    }
  }

private:
  void send(int process, const Request& request) const
  {
    MPI_Send(&request, static_cast<int>(sizeof(request)), MPI_BYTE, process, RequestTag,
      this->Vertices.team().communicator());
  }

  void readFrom(int owner, const Request& request, double* values) const
  {
    const auto count = static_cast<int>(request.count) * this->columns();
    if (owner == 0)
    {
      std::copy_n(valuesOf(this->Vertices, this->Part, request.first), count, values);
      return;
    }
    this->send(owner, request);
    MPI_Recv(values, count, MPI_DOUBLE, owner, ValuesTag, this->Vertices.team().communicator(),
      MPI_STATUS_IGNORE);
  }

  const SharedVertices& Vertices;
  const DistributedSolution& Part;
};

/** Answers the requests of process 0. */
void serve(const SharedVertices& vertices, const DistributedSolution& solution)
{
  const MPI_Comm processes = vertices.team().communicator();
  while (true)
  {
    Request request;
    MPI_Recv(&request, static_cast<int>(sizeof(request)), MPI_BYTE, 0, RequestTag, processes,
      MPI_STATUS_IGNORE);
    if (request.count == 0)
    {
      return;
    }
    MPI_Send(valuesOf(vertices, solution, request.first),
      static_cast<int>(request.count) * solution.columns, MPI_DOUBLE, 0, ValuesTag, processes);
  }
}

} // namespace

void gatherSolution(const SharedVertices& vertices, const DistributedSolution& solution,
  const std::function<void(Solution&)>& use)
{
  if (vertices.team().rank() != 0)
  {
    serve(vertices, solution);
    return;
  }
  GatheredSolution whole(vertices, solution);
  use(whole);
}

} // namespace smg
