// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Passes all of `numbers` to `take`, in consecutive ranges, each a multiple of `count`. */
template <class Take>
void forEachStretch(const RecordFile<std::uint32_t>& numbers, std::size_t count, Take&& take)
{
  const std::size_t most = (std::size_t(16) << 10) / count * count;
  std::vector<std::uint32_t> stretch;
  RecordFile<std::uint32_t>::Reader reader(numbers);
  for (std::int64_t left = numbers.size(); left > 0;
       left -= static_cast<std::int64_t>(stretch.size()))
  {
    stretch.resize(std::min(most, static_cast<std::size_t>(left)));
    reader.next(stretch);
    take(std::span<const std::uint32_t>(stretch));
  }
}

/** Passes the vertices of the mesh to `take`: the number, and the three coordinates as `Real`. */
template <class Real, class Take>
void forEachVertex(const RawMesh& mesh, Take&& take)
{
  constexpr std::size_t bytes = 3 * sizeof(Real);
  BucketFile::Reader reader(mesh.positions);
  std::uint32_t vertex = 0;
  for (auto stretch = reader.next(bytes); !stretch.empty(); stretch = reader.next(bytes))
  {
    const Real* position = reinterpret_cast<const Real*>(stretch.data());
    for (std::size_t i = 0; i < stretch.size() / bytes; ++i)
    {
      take(vertex++, position + 3 * i);
    }
  }
}

} // namespace smg
