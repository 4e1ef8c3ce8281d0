// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/ListedElements.h"

#include "IO/Files/InputFile.h"
#include <string>

namespace smg
{

namespace
{
constexpr std::uint32_t ShellBit = 4; ///< above the dimension
} // namespace

void ListedElements::add(
  std::uint32_t number, ElementKind kind, std::span<const std::int64_t> corners)
{
  std::array<std::uint32_t, MostCorners + 2> record{ number,
    (kind.dimension | (kind.isShell ? ShellBit : 0)) << 8 |
      static_cast<std::uint32_t>(corners.size()) };
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    if (corners[k] < 0 || corners[k] > std::int64_t(UINT32_MAX))
    {
      throw MeshError("the corner " + std::to_string(corners[k]) + " is not a vertex");
    }
    record[k + 2] = static_cast<std::uint32_t>(corners[k]);
  }
  this->Elements.put(std::span<const std::uint32_t>(record).first(corners.size() + 2));
}

void ListedElements::put(std::uint32_t number, std::uint32_t list, std::uint32_t side)
{
  if (!this->Entries)
  {
    this->Entries.emplace(this->Space, this->Space.available() / 4);
  }
  this->Entries->put({ number, list, side });
}

bool ListedElements::Element::next(RecordFile<std::uint32_t>::Reader& reader)
{
  std::uint32_t shape = 0;
  if (!reader.next(this->number) || !reader.next(shape))
  {
    return false;
  }
  const std::uint32_t code = shape >> 8;
  this->kind = { static_cast<std::uint8_t>(code % ShellBit), code >= ShellBit };
  this->count = shape & 255;
  for (std::size_t k = 0; k < this->count; ++k)
  {
    std::uint32_t corner = 0;
    reader.next(corner);
    this->corners[k] = corner;
  }
  return true;
}

} // namespace smg
