// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** A column of a parsed mesh, of its vertices or of its elements. */
class ImportColumn
{
public:
  enum class Of : std::uint8_t
  {
    Vertices,
    Elements
  };

  ImportColumn(RawMeshBuilder& builder, Of of, const ColumnSpec& spec)
    : Builder(&builder)
    , Owners(of)
    , Number(of == Of::Vertices ? builder.addVertexColumn(spec) : builder.addElementColumn(spec))
  {
  }

  void append(std::span<const std::byte> tuples)
  {
    this->Owners == Of::Vertices ? this->Builder->vertexTuples(this->Number, tuples)
                                 : this->Builder->elementTuples(this->Number, tuples);
  }
  /** Removes the column. */
  void drop()
  {
    this->Owners == Of::Vertices ? this->Builder->dropVertexColumn(this->Number)
                                 : this->Builder->dropElementColumn(this->Number);
  }

private:
  RawMeshBuilder* Builder;
  Of Owners;
  int Number;
};

/** Appends a tuple of at most four numbers, as values of T, the type of the column. */
template <class T>
void appendAs(std::span<const double> numbers, ImportColumn& column)
{
  std::array<T, 4> tuple{};
  const std::size_t size = std::min(tuple.size(), numbers.size());
  for (std::size_t k = 0; k < size; ++k)
  {
    tuple[k] = static_cast<T>(numbers[k]);
  }
  column.append(std::as_bytes(std::span(tuple).first(size)));
}

} // namespace smg
