// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DeformationDescription.h"

#include "smg/Deform.h"

namespace smg
{

DeformationDescription DeformationDescription::byColumns()
{
  DeformationDescription description;
  description.handles = { { ColumnMask{ HandleMaskName },
    HandleDescription::Values{ HandleTargetName, HandleRotationName, HandleLogScaleName } } };
  return description;
}

void DeformationDescription::applyTo(DeformOptions& options) const
{
  options.weights = this->weights.value_or(options.weights);
  if (this->cycles)
  {
    options.cycles = *this->cycles;
  }
  if (this->tolerance)
  {
    options.cycles = 0;
    options.tolerance = *this->tolerance;
  }
}

} // namespace smg
