// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** Colours in a text: shares of 1, which other programs refuse outside 0 to 1. */
class WrittenColors
{
public:
  /** Component k of the colour of a tuple: 0 to 1. Of a column of bytes its share of 255. */
  float share(const Column& colors, std::size_t tuple, int k)
  {
    const double one = colors.spec.type == ScalarType::UInt8 ? 255.0 : 1.0;
    const double share = colors.value(tuple, k) / one;
    const bool isInside = share >= 0.0 && share <= 1.0;
    this->Outside += isInside ? 0 : 1;
    return isInside ? static_cast<float>(share) : share > 1.0 ? 1.0F : 0.0F;
  }

  /** Adds how many numbers were not between 0 and 1, if any. */
  void addNote(WriteNotes& notes) const
  {
    if (this->Outside > 0)
    {
      notes.push_back(counted(this->Outside, "number of a colour is", "numbers of colours are") +
                      " outside 0 to 1, and written as the nearer one of these.");
    }
  }

private:
  std::int64_t Outside = 0;
};

} // namespace smg
