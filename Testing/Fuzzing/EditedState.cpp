// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzzing/EditedState.h"

#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Files/State.h"

#include <algorithm>
#include <cstring>

namespace smg::testing
{

namespace
{

/** Removes the first `count` bytes of `from`, or all if there are not so many, and returns them. */
std::string_view take(std::string_view& from, std::size_t count)
{
  const std::string_view taken = from.substr(0, count);
  from.remove_prefix(taken.size());
  return taken;
}

/** A place in a file of this size. */
std::size_t takePlace(std::string_view& from, std::size_t size)
{
  std::size_t place = 0;
  for (const char byte : take(from, 2))
  {
    place = place << 8 | static_cast<unsigned char>(byte);
  }
  return size > 0 ? place % size : 0;
}

void applyEdit(std::string& file, std::string_view& edits)
{
  const int kind = static_cast<unsigned char>(take(edits, 1).front()) % 4;
  const std::size_t place = takePlace(edits, file.size());
  const std::string_view counted = take(edits, 1);
  std::size_t count = counted.empty() ? 0 : static_cast<unsigned char>(counted.front()) % 64;
  switch (kind)
  {
    case 0:
    {
      const std::string_view bytes = take(edits, count);
      file.replace(place, bytes.size(), bytes);
      break;
    }
    case 1:
      file.insert(place, take(edits, count));
      break;
    case 2:
      file.erase(place, count);
      break;
    default:
      const std::string copied = file.substr(takePlace(edits, file.size()), count);
      file.replace(place, copied.size(), copied);
  }
}

/** Corrects sizes and checksums. */
void seal(std::string& file)
{
  StateFront front{};
  if (file.size() < sizeof(front))
  {
    return;
  }
  std::memcpy(&front, file.data(), sizeof(front));
  std::span<const std::byte> content = std::as_bytes(std::span(file)).subspan(sizeof(front));
  front.bytes = static_cast<std::int64_t>(content.size());
  front.checksum = 0;
  while (!content.empty())
  {
    const std::size_t page = std::min(content.size(), StatePages::Bytes);
    front.checksum = StatePages::add(front.checksum, content.first(page));
    content = content.subspan(page);
  }
  front.frontChecksum = front.expectedChecksum();
  std::memcpy(file.data(), &front, sizeof(front));
}

} // namespace

std::string editedState(std::string_view state, std::string_view edits)
{
  std::string file(state);
  while (!edits.empty())
  {
    applyEdit(file, edits);
  }
  seal(file);
  return file;
}

} // namespace smg::testing
