// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** `lanes` values of T for each open vertex of a mesh stream: one that a later cell may use. */
template <class T>
class OpenValues
{
public:
  explicit OpenValues(int lanes = 1)
    : Lanes(static_cast<std::size_t>(lanes))
  {
  }

  /** Releases all vertices; the next one is vertex 0. */
  void restart()
  {
    this->Values.clear();
    this->First = 0;
  }

  /** Releases the vertices below `final`, immediately or later. */
  void release(std::int64_t final)
  {
    // Values are moved only when half of them are released: amortised once per value.
    const auto dead = static_cast<std::size_t>(final - this->First) * this->Lanes;
    if (dead > this->Values.size() / 2)
    {
      this->Values.erase(
        this->Values.begin(), this->Values.begin() + static_cast<std::ptrdiff_t>(dead));
      this->First = final;
    }
  }

  /** Appends zeroed values for the next `vertices` vertices. */
  std::span<T> append(std::int64_t vertices)
  {
    const std::size_t before = this->Values.size();
    this->Values.resize(before + static_cast<std::size_t>(vertices) * this->Lanes);
    return std::span(this->Values).subspan(before);
  }

  /** The values of an open vertex. */
  T* at(std::int64_t vertex) { return this->Values.data() + this->place(vertex); }
  const T* at(std::int64_t vertex) const { return this->Values.data() + this->place(vertex); }

private:
  std::size_t place(std::int64_t vertex) const
  {
    return static_cast<std::size_t>(vertex - this->First) * this->Lanes;
  }

  std::size_t Lanes;
  std::vector<T> Values;
  std::int64_t First = 0; ///< the vertex of the first of the values
};

} // namespace smg
