// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkTuples.h"

#include <cmath>

namespace smg
{

void convertVtkScalars(
  const VtkArray& array, const std::byte* from, std::size_t count, std::byte* to)
{
  dispatch(array.type,
    [&]<class From>(From)
    {
      dispatch(array.columnType,
        [&]<class To>(To)
        {
          for (std::size_t i = 0; i < count; ++i)
          {
            From value;
            std::memcpy(&value, from + i * sizeof(From), sizeof(From));
            To result{};
            if (array.isFractions)
            {
              const double clamped = std::clamp(static_cast<double>(value), 0.0, 1.0);
              result = static_cast<To>(std::lround(std::isnan(clamped) ? 0.0 : clamped * 255.0));
            }
            else
            {
              result = static_cast<To>(value);
            }
            std::memcpy(to + i * sizeof(To), &result, sizeof(To));
          }
        });
    });
}

} // namespace smg
