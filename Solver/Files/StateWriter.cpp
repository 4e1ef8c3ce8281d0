// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/StateWriter.h"

#include "Solver/Files/Checksum.h"

#include <algorithm>
#include <array>

namespace smg
{

std::uint64_t StatePages::add(std::uint64_t checksum, std::span<const std::byte> page)
{
  const std::array<std::uint64_t, 2> both{ checksum, smg::checksum(page) };
  return smg::checksum(std::as_bytes(std::span(both)));
}

void StateWriter::write(std::span<const std::byte> bytes)
{
  while (!bytes.empty())
  {
    const std::size_t part = std::min(bytes.size(), StatePages::Bytes - this->Page.size());
    this->Page.insert(this->Page.end(), bytes.begin(), bytes.begin() + part);
    bytes = bytes.subspan(part);
    if (this->Page.size() == StatePages::Bytes)
    {
      this->finish();
    }
  }
}

void StateWriter::finish()
{
  if (!this->Page.empty())
  {
    this->File.write(this->End, this->Page);
    this->Checksum = StatePages::add(this->Checksum, this->Page);
    this->End += static_cast<std::int64_t>(this->Page.size());
    this->Page.clear();
  }
}

} // namespace smg
