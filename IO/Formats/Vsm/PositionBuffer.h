// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace smg
{

/** Collects coordinates in the precision of a file. */
class PositionBuffer
{
public:
  explicit PositionBuffer(bool doublePositions)
    : IsDouble(doublePositions)
  {
  }

  /** Appends a coordinate; returns false if it is not finite or out of range in that precision. */
  bool append(double x)
  {
    const auto single = static_cast<float>(x);
    if (!std::isfinite(x) || (!this->IsDouble && static_cast<double>(single) != x))
    {
      return false;
    }
    if (this->IsDouble)
    {
      this->Doubles.push_back(x);
    }
    else
    {
      this->Floats.push_back(single);
    }
    return true;
  }

  std::size_t positions() const { return (this->Doubles.size() + this->Floats.size()) / 3; }
  std::span<const std::byte> bytes() const
  {
    return this->IsDouble ? std::as_bytes(std::span(this->Doubles))
                          : std::as_bytes(std::span(this->Floats));
  }
  void clear()
  {
    this->Doubles.clear();
    this->Floats.clear();
  }

private:
  bool IsDouble;
  std::vector<double> Doubles;
  std::vector<float> Floats;
};

} // namespace smg
