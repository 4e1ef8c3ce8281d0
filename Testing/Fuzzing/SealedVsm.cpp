// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzzing/SealedVsm.h"

#include "IO/External/BlockFile.h"
#include "Solver/Files/Checksum.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace smg::testing
{

namespace
{

constexpr auto HeaderBytes = static_cast<std::size_t>(BlockFileHeaderBytes);

std::uint64_t checksumOf(std::string_view bytes)
{
  return checksum(std::as_bytes(std::span(bytes)));
}

BlockFileFront frontOf(std::string_view bytes)
{
  BlockFileFront front{};
  std::memcpy(&front, bytes.data(), sizeof(front));
  return front;
}

/** Bytes of the front and the header in JSON, as far as they exist. */
std::size_t textEnd(std::string_view bytes)
{
  const auto most = static_cast<std::int64_t>(std::min(bytes.size(), HeaderBytes));
  const auto front = static_cast<std::int64_t>(sizeof(BlockFileFront));
  return static_cast<std::size_t>(
    front + std::clamp<std::int64_t>(frontOf(bytes).headerBytes, 0, most - front));
}

/** Corrects the checksums of the columns; the tail must be complete. */
void sealColumns(std::string& file, std::size_t tailOffset)
{
  const std::string_view tail = std::string_view(file).substr(tailOffset);
  try
  {
    BlockFileIndex index = BlockFileIndex::parse(
      std::as_bytes(std::span(tail)), static_cast<std::int64_t>(tailOffset), "");
    for (TableIndex& table : index.blocks)
    {
      for (std::size_t block = 0; block < table.offset.size(); ++block)
      {
        auto offset = static_cast<std::size_t>(table.offset[block]);
        const std::size_t columns = table.entries.size() / table.offset.size();
        for (ColumnEntry& entry : std::span(table.entries).subspan(block * columns, columns))
        {
          entry.checksum = checksumOf(std::string_view(file).substr(offset, entry.storedBytes));
          offset += entry.storedBytes;
        }
      }
    }
    const std::vector<std::byte> sealed = index.serialize();
    file.replace(
      tailOffset, tail.size(), reinterpret_cast<const char*>(sealed.data()), sealed.size());
  }
  catch (const Error&)
  {
    // The index is invalid: the reader must detect this.
  }
}

} // namespace

std::string sealedVsm(std::string_view bytes)
{
  if (bytes.size() < sizeof(BlockFileFront))
  {
    return std::string(bytes);
  }
  BlockFileFront front = frontOf(bytes);
  const std::size_t text = textEnd(bytes);
  std::string file(bytes.substr(0, text));
  file.resize(HeaderBytes);
  file += bytes.substr(text);
  const auto tailOffset = static_cast<std::size_t>(front.tailOffset);
  if (tailOffset >= HeaderBytes && tailOffset <= file.size())
  {
    sealColumns(file, tailOffset);
    front.tailBytes = static_cast<std::int64_t>(file.size() - tailOffset);
    front.tailChecksum = checksumOf(std::string_view(file).substr(tailOffset));
  }
  front.headerChecksum =
    checksumOf(std::string_view(file).substr(sizeof(front), text - sizeof(front)));
  front.frontChecksum =
    checksum(std::as_bytes(std::span(&front, 1)).first(offsetof(BlockFileFront, frontChecksum)));
  std::memcpy(file.data(), &front, sizeof(front));
  return file;
}

} // namespace smg::testing
