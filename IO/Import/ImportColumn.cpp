// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/ImportColumn.h"

#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace smg
{

namespace
{

bool isColor(std::span<const double> numbers)
{
  return numbers.size() == 3 || numbers.size() == 4;
}

bool areBytes(std::span<const double> numbers)
{
  return std::ranges::all_of(numbers,
    [](double number) { return number >= 0 && number <= 255 && number == std::floor(number); });
}

} // namespace

void TextColors::add(std::span<const double> numbers)
{
  if (this->Owned++ == 0)
  {
    this->Components = isColor(numbers) ? numbers.size() : 0;
  }
  if (this->Dropped || (this->Components == 0 && !isColor(numbers)))
  {
    return;
  }
  if (!this->fits(numbers))
  {
    this->drop();
    return;
  }
  if (!this->Column)
  {
    const double largest = std::ranges::max(numbers);
    if (largest == 0.0)
    {
      return; // black, like all before
    }
    this->begin(this->Owned - 1, largest > 1.0);
  }
  this->append(numbers);
}

void TextColors::finish()
{
  if (!this->Column && this->Components > 0 && !this->Dropped)
  {
    this->begin(this->Owned, true);
  }
}

/** Makes the column, starting with this number of black ones. */
void TextColors::begin(std::int64_t black, bool bytes)
{
  this->Bytes = bytes;
  this->Column.emplace(this->Builder, this->Owners,
    ColumnSpec{ ColorsName, bytes ? ScalarType::UInt8 : ScalarType::Float32,
      static_cast<int>(this->Components) });
  const std::array<double, 4> zeros{};
  for (std::int64_t i = 0; i < black; ++i)
  {
    this->append(std::span(zeros).first(this->Components));
  }
}

/** Whether the numbers are a colour like the previous ones. */
bool TextColors::fits(std::span<const double> numbers) const
{
  if (numbers.size() != this->Components)
  {
    return false;
  }
  const bool areShares =
    std::ranges::all_of(numbers, [](double number) { return number >= 0 && number <= 1; });
  if (!this->Column)
  {
    return areShares || areBytes(numbers);
  }
  return this->Bytes ? areBytes(numbers) : areShares;
}

void TextColors::append(std::span<const double> numbers)
{
  this->Bytes ? appendAs<std::uint8_t>(numbers, *this->Column)
              : appendAs<float>(numbers, *this->Column);
}

void TextColors::drop()
{
  const bool ofVertices = this->Owners == ColumnOf::Vertices;
  if (this->Column)
  {
    this->Column->drop();
  }
  this->Dropped = true;
  this->Builder.note(std::string("The colours of the ") + (ofVertices ? "vertices" : "faces") +
                     " are left out, since not all of them have one of the same kind.");
}

} // namespace smg
