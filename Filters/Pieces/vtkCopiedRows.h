// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataSetAttributes.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Copies some tuples of all arrays, in this order, to attributes without arrays. */
inline void copyRows(
  vtkDataSetAttributes& from, std::span<const std::int64_t> rows, vtkDataSetAttributes& to)
{
  const auto count = static_cast<vtkIdType>(rows.size());
  to.CopyAllOn();
  to.CopyAllocate(&from, count);
  to.SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    to.CopyData(&from, rows[static_cast<std::size_t>(i)], i);
  }
}

} // namespace smg
