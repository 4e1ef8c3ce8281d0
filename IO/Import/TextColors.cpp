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
  if (!this->Begun)
  {
    this->begin(numbers);
  }
  if (this->Dropped || (this->Column < 0 && !isColor(numbers)))
  {
    return;
  }
  if (!this->fits(numbers))
  {
    this->drop();
    return;
  }
  if (this->Spec.type == ScalarType::UInt8)
  {
    const auto tuple = converted<std::uint8_t>(numbers);
    this->append(std::as_bytes(std::span(tuple).first(numbers.size())));
  }
  else
  {
    const auto tuple = converted<float>(numbers);
    this->append(std::as_bytes(std::span(tuple).first(numbers.size())));
  }
}

void TextColors::begin(std::span<const double> numbers)
{
  this->Begun = true;
  if (!isColor(numbers))
  {
    return;
  }
  const bool bytes = areBytes(numbers) && std::ranges::max(numbers) > 1;
  this->Spec = { ColorsName, bytes ? ScalarType::UInt8 : ScalarType::Float32,
    static_cast<int>(numbers.size()) };
  this->Column = this->Owners == Of::Vertices ? this->Builder.addVertexColumn(this->Spec)
                                              : this->Builder.addElementColumn(this->Spec);
}

bool TextColors::fits(std::span<const double> numbers) const
{
  return this->Column >= 0 && numbers.size() == static_cast<std::size_t>(this->Spec.components) &&
         (this->Spec.type != ScalarType::UInt8 || areBytes(numbers));
}

void TextColors::append(std::span<const std::byte> tuple)
{
  this->Owners == Of::Vertices ? this->Builder.vertexTuples(this->Column, tuple)
                               : this->Builder.elementTuples(this->Column, tuple);
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
