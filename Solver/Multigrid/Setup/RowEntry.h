// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/** An off-diagonal entry of row i of a level's matrix: A_ij = -weight, j = i + delta. Seven bytes,
 * since all rows that are alive while levels are built consist of these. */
class RowEntry
{
public:
  /** Of two nodes that share an edge. */
  static constexpr std::int64_t MostDistance = (std::int64_t(1) << 23) - 1;

  RowEntry() = default;
  RowEntry(std::int32_t delta, float weight)
  {
    const std::int32_t shifted = delta * 256;
    std::memcpy(this->Bytes.data() + 3, &shifted, sizeof(shifted));
    this->setWeight(weight);
  }

  /** From -MostDistance to MostDistance. */
  std::int32_t delta() const
  {
    std::int32_t shifted = 0;
    std::memcpy(&shifted, this->Bytes.data() + 3, sizeof(shifted));
    return shifted >> 8;
  }
  float weight() const
  {
    float weight = 0.0F;
    std::memcpy(&weight, this->Bytes.data(), sizeof(weight));
    return weight;
  }
  void setWeight(float weight) { std::memcpy(this->Bytes.data(), &weight, sizeof(weight)); }

private:
  std::array<std::byte, 7> Bytes; // the weight and 24 bits of delta
};
static_assert(sizeof(RowEntry) == 7 && std::endian::native == std::endian::little);

} // namespace smg
