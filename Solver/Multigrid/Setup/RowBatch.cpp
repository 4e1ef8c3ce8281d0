// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/RowBatch.h"

namespace smg
{

void finishRow(CoarseningData& data, std::int64_t c, std::int64_t lastChild, RowBatch& out)
{
  const std::int64_t size = data.raw.size(c);
  const CoarseEntry* raw = data.raw.row(c);
  std::int32_t* settled = data.rawSettled.at(c);
  for (std::int64_t e = data.rawLower[c]; e < size; ++e)
  {
    const std::int32_t delta = raw[e].offset(c);
    data.raw.row(c + delta)[settled[delta]++].takeValue(raw[e]);
  }
  RowEntry* entries = out.open(size);
  std::int64_t kept = 0;
  for (std::int64_t e = 0; e < size; ++e)
  {
    entries[kept] = { raw[e].offset(c), raw[e].value() };
    kept += raw[e].removed() ? 0 : 1;
  }
  out.close(kept, data.rawAlpha[c], lastChild, data.rawStrongest[c].stiff());
}

} // namespace smg
