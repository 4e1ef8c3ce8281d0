// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/OpenComponents.h"

#include <algorithm>

namespace smg
{

void OpenComponents::extend(std::int64_t vertices)
{
  const std::int64_t begin = this->Labels.end();
  if (vertices > begin)
  {
    this->Labels.extendRaw(vertices);
    std::ranges::fill(this->Labels.range(begin, vertices), -1);
  }
}

/** Joins corners that do not all have the same label. */
void OpenComponents::joinOthers(const std::int64_t* corners, int count)
{
  std::int32_t* of[4] = {};
  std::int32_t label = -1;
  for (int k = 0; k < count; ++k)
  {
    of[k] = this->Labels.at(corners[k]);
    const std::int32_t other = *of[k];
    label = label < 0                     ? other
            : other < 0 || other == label ? label
                                          : this->Parts.join(label, other);
  }
  label = label < 0 ? this->Parts.add() : label;
  for (int k = 0; k < count; ++k)
  {
    *of[k] = label;
  }
}

std::int32_t OpenComponents::close(std::int64_t i, double mass)
{
  const std::int32_t label =
    this->Labels[i] < 0 ? ComponentLabels::None : this->Parts.root(this->Labels[i]);
  this->LabelBatch.push_back(label);
  this->MassBatch.push_back(mass);
  return label;
}

std::int32_t OpenComponents::closeUndetermined(std::int64_t i)
{
  const std::int32_t label = this->close(i, 0.0);
  this->LabelBatch.back() = ComponentLabels::Undetermined;
  return label;
}

void OpenComponents::flush()
{
  this->Closed.append(this->LabelBatch, this->MassBatch);
  this->LabelBatch.clear();
  this->MassBatch.clear();
}

} // namespace smg
