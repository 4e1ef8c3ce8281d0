// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/RowBatch.h"

// Makes a row of the coarse operator exactly symmetric to its neighbours. The products (P^T A P)_ck
// and (P^T A P)_kc are sums in different orders and round differently, and sparsification changes
// only the upper entry of a pair. The lower entry is therefore overwritten by the upper one of the
// lower-numbered row. The position is a counter, not a search: the rows below k finish in ascending
// order, in which row k lists them.

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
    // Also if it was removed, so that the mirrored entry is removed, too.
    data.raw.row(c + delta)[settled[delta]++].takeValue(raw[e]);
  }
  RowEntry* entries = out.open(size);
  std::int64_t kept = 0;
  for (std::int64_t e = 0; e < size; ++e)
  {
    // Written in any case and kept if not removed: no branch.
    entries[kept] = { raw[e].offset(c), raw[e].value() };
    kept += raw[e].removed() ? 0 : 1;
  }
  out.close(kept, data.rawRowSum[c], lastChild, data.rawStrongest[c].stiff());
}

} // namespace smg
