// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The vertices of a part that other processes own or use, and the exchange of numbers at these. */
class SMG_EXPORT SharedVertices
{
public:
  /** Called on all processes. Throws Error if the parts do not fit together. */
  SharedVertices(Team& team, const MeshPart& part);

  Team& team() const { return this->Processes; }
  /** Number of vertices of the part. */
  std::int64_t vertices() const { return static_cast<std::int64_t>(this->Ids.size()); }
  /** Those that the process owns: [begin(), end()) in the numbering of the part. */
  std::int64_t begin() const { return this->Begin; }
  std::int64_t end() const { return this->End; }
  bool isOwn(std::int64_t vertex) const { return vertex >= this->Begin && vertex < this->End; }
  /** Whether other processes have the vertex, too. */
  bool isShared(std::int64_t vertex) const
  {
    return this->Shared[static_cast<std::size_t>(vertex)] != 0;
  }
  /** The stream index of a vertex, given its place in the part. */
  std::int64_t id(std::int64_t vertex) const { return this->Ids[static_cast<std::size_t>(vertex)]; }
  /** The place in the part of a stream index; -1: the part does not have it. */
  std::int64_t find(std::int64_t id) const;
  /** The process that owns a stream index. */
  int ownerOf(std::int64_t id) const;
  /** The end of the stream indices that a process owns. */
  std::int64_t endOf(int process) const { return this->Ends[static_cast<std::size_t>(process)]; }

  /** Adds the `lanes` numbers of each vertex to those at its owner. */
  void addToOwners(std::span<double> values, int lanes) const;
  /** Replaces the numbers of each vertex by those at its owner. */
  template <class T>
  void copyFromOwners(std::span<T> values, int lanes) const;
  /** The first vertex of the part whose numbers differ from those at its owner by more than
   * `tolerance` times the largest magnitude at shared vertices; -1: none. take(vertex, numbers)
   * sets the `lanes` numbers of a vertex. */
  template <class Take>
  std::int64_t findDifferent(int lanes, double tolerance, Take&& take) const;
  /** Calls join(vertex, value) for each own vertex that others use, with the value at each of them,
   * one process after the other. */
  template <class T, class Join>
  void collect(std::span<const T> values, Join&& join) const;

private:
  void checkIds() const;
  /** The numbers of these vertices. */
  template <class T>
  static std::vector<std::vector<T>> pack(const std::vector<std::vector<std::int64_t>>& vertices,
    std::span<const T> values, std::size_t lanes);

  Team& Processes;
  std::span<const std::int64_t> Ids;
  std::vector<std::int64_t> Ends; ///< end of the stream indices that each process owns
  std::int64_t Begin = 0, End = 0;
  std::vector<std::vector<std::int64_t>> Foreign; ///< by process: vertices of the part that it owns
  std::vector<std::vector<std::int64_t>> Used;    ///< by process: own vertices that it uses
  std::vector<std::uint8_t> Shared;
};

template <class T>
std::vector<std::vector<T>> SharedVertices::pack(
  const std::vector<std::vector<std::int64_t>>& vertices, std::span<const T> values,
  std::size_t lanes)
{
  std::vector<std::vector<T>> packed(vertices.size());
  for (std::size_t p = 0; p < vertices.size(); ++p)
  {
    for (const std::int64_t v : vertices[p])
    {
      const auto first = values.begin() + v * static_cast<std::ptrdiff_t>(lanes);
      packed[p].insert(packed[p].end(), first, first + static_cast<std::ptrdiff_t>(lanes));
    }
  }
  return packed;
}

template <class T>
void SharedVertices::copyFromOwners(std::span<T> values, int lanes) const
{
  const auto each = static_cast<std::size_t>(lanes);
  const auto received =
    this->Processes.exchange(pack(this->Used, std::span<const T>(values), each));
  for (std::size_t p = 0; p < received.size(); ++p)
  {
    for (std::size_t k = 0; k < received[p].size(); ++k)
    {
      values[static_cast<std::size_t>(this->Foreign[p][k / each]) * each + k % each] =
        received[p][k];
    }
  }
}

template <class Take>
std::int64_t SharedVertices::findDifferent(int lanes, double tolerance, Take&& take) const
{
  const auto each = static_cast<std::size_t>(lanes);
  std::vector<std::vector<double>> owned(this->Used.size());
  for (std::size_t p = 0; p < owned.size(); ++p)
  {
    owned[p].resize(this->Used[p].size() * each);
    for (std::size_t k = 0; k < this->Used[p].size(); ++k)
    {
      take(this->Used[p][k], std::span(owned[p]).subspan(k * each, each));
    }
  }
  const auto received = this->Processes.exchange(owned);
  double largest = 0.0;
  for (const std::vector<double>& numbers : received)
  {
    for (const double number : numbers)
    {
      largest = std::max(largest, std::fabs(number));
    }
  }
  std::vector<double> own(each);
  const auto isSame = [allowed = tolerance * largest](double a, double b)
  { return std::fabs(a - b) <= allowed; };
  std::int64_t first = -1;
  for (std::size_t p = 0; p < received.size(); ++p)
  {
    for (std::size_t k = 0; k < this->Foreign[p].size(); ++k)
    {
      const std::int64_t v = this->Foreign[p][k];
      take(v, std::span(own));
      const auto owners = received[p].begin() + static_cast<std::ptrdiff_t>(k * each);
      if (!std::equal(own.begin(), own.end(), owners, isSame))
      {
        first = first < 0 ? v : std::min(first, v);
      }
    }
  }
  return first;
}

template <class T, class Join>
void SharedVertices::collect(std::span<const T> values, Join&& join) const
{
  const auto received = this->Processes.exchange(pack(this->Foreign, values, 1));
  for (std::size_t p = 0; p < received.size(); ++p)
  {
    for (std::size_t k = 0; k < received[p].size(); ++k)
    {
      join(this->Used[p][k], received[p][k]);
    }
  }
}

} // namespace smg
