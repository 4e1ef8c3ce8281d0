// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/TextColors.h"

#include "IO/Container/AttributeNames.h"

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

template <class T>
std::array<T, 4> converted(std::span<const double> numbers)
{
  std::array<T, 4> tuple{};
  for (std::size_t k = 0; k < std::min(tuple.size(), numbers.size()); ++k)
  {
    tuple[k] = static_cast<T>(numbers[k]);
  }
  return tuple;
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
  if (this->Column < 0)
  {
    const double largest = std::ranges::max(numbers);
    if (largest == 0.0)
    {
      return; // black, as all before
    }
    this->begin(this->Owned - 1, largest > 1.0);
  }
  this->append(numbers);
}

void TextColors::finish()
{
  if (this->Column < 0 && this->Components > 0 && !this->Dropped)
  {
    this->begin(this->Owned, true);
  }
}

/** Makes the column, with so many black ones. */
void TextColors::begin(std::int64_t black, bool bytes)
{
  this->Spec = { ColorsName, bytes ? ScalarType::UInt8 : ScalarType::Float32,
    static_cast<int>(this->Components) };
  this->Column = this->Owners == Of::Vertices ? this->Builder.addVertexColumn(this->Spec)
                                              : this->Builder.addElementColumn(this->Spec);
  const std::array<double, 4> zeros{};
  for (std::int64_t i = 0; i < black; ++i)
  {
    this->append(std::span(zeros).first(this->Components));
  }
}

/** Whether the numbers are a colour as those before. */
bool TextColors::fits(std::span<const double> numbers) const
{
  if (numbers.size() != this->Components)
  {
    return false;
  }
  const bool areShares =
    std::ranges::all_of(numbers, [](double number) { return number >= 0 && number <= 1; });
  if (this->Column < 0)
  {
    return areShares || areBytes(numbers);
  }
  return this->Spec.type == ScalarType::UInt8 ? areBytes(numbers) : areShares;
}

void TextColors::append(std::span<const double> numbers)
{
  const auto put = [this](std::span<const std::byte> tuple)
  {
    this->Owners == Of::Vertices ? this->Builder.vertexTuples(this->Column, tuple)
                                 : this->Builder.elementTuples(this->Column, tuple);
  };
  if (this->Spec.type == ScalarType::UInt8)
  {
    const auto tuple = converted<std::uint8_t>(numbers);
    put(std::as_bytes(std::span(tuple).first(numbers.size())));
  }
  else
  {
    const auto tuple = converted<float>(numbers);
    put(std::as_bytes(std::span(tuple).first(numbers.size())));
  }
}

void TextColors::drop()
{
  const bool ofVertices = this->Owners == Of::Vertices;
  ofVertices ? this->Builder.dropVertexColumn(this->Column)
             : this->Builder.dropElementColumn(this->Column);
  this->Dropped = true;
  this->Builder.note(std::string("The colours of the ") + (ofVertices ? "vertices" : "faces") +
                     " are left out, since not all of them have one of the same kind.");
}

} // namespace smg
