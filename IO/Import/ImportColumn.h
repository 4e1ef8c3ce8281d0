// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

/** A column of a parsed mesh, of its vertices or of its elements. It does nothing if the mesh
 * cannot have it, or was made without one. */
class ImportColumn
{
public:
  ImportColumn() = default;
  ImportColumn(RawMeshBuilder& builder, ColumnOf of, const ColumnSpec& spec)
    : Column(builder.addColumn(of, spec))
  {
  }

  bool exists() const { return this->Column != nullptr; }
  /** What was appended; of a column that exists. */
  const BucketFile& tuples() const { return this->Column->tuples; }
  void append(std::span<const std::byte> tuples)
  {
    if (this->Column)
    {
      this->Column->tuples.append(0, tuples);
    }
  }
  /** After the last tuple, releases the memory of its last chunk. */
  void close()
  {
    if (this->Column)
    {
      this->Column->tuples.close();
    }
  }
  /** Removes the column. */
  void drop()
  {
    if (this->Column)
    {
      this->Column->isDropped = true;
    }
  }

private:
  RawMeshBuilder::BuiltColumn* Column = nullptr;
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

/** A column of labels, one integer each, which is omitted if all vertices or all cells of the mesh
 * have the default value: only the whole file tells whether the mesh has it. */
class LabelColumn
{
public:
  /** Where the dimension does not matter, as of vertices. */
  static constexpr int AnyDimension = 4;

  LabelColumn(RawMeshBuilder& builder, ColumnOf of, const char* name, std::int64_t usual = 0)
    : Builder(&builder)
    , Usual(usual)
  {
    if (!builder.looks())
    {
      this->Column = ImportColumn(builder, of, { name, ScalarType::Int64, 1 });
    }
  }

  /** Of an element its dimension: only labels of cells of the mesh make it a column. */
  void add(std::int64_t label, int dimension = AnyDimension)
  {
    this->Column.append(std::as_bytes(std::span(&label, 1)));
    bool& used = this->Used[static_cast<std::size_t>(dimension)];
    used = used || label != this->Usual;
  }
  /** To be called after the last one. */
  void finish()
  {
    this->Column.close();
    if (!this->Used[static_cast<std::size_t>(this->Builder->dimension())] &&
        !this->Used[AnyDimension])
    {
      this->Column.drop();
    }
  }
  /** Removes the column. */
  void drop() { this->Column.drop(); }
  const ImportColumn& column() const { return this->Column; }

private:
  RawMeshBuilder* Builder;
  ImportColumn Column;
  std::int64_t Usual;
  std::array<bool, AnyDimension + 1> Used{}; ///< whether any differs from the default
};

/**
 * The column `Colors` from the numbers after the vertices or the faces of a text file, three or
 * four each. The first colour that is not black determines the type: integers up to 255, at least
 * one of them above 1, are bytes; others are single precision numbers up to 1. If colours differ in
 * type, there is no column, with a note.
 */
class TextColors
{
public:
  TextColors(RawMeshBuilder& builder, ColumnOf of)
    : Builder(builder)
    , Owners(of)
  {
  }

  /** Adds the numbers of the next vertex or face, which has no colour unless there are three or
   * four. */
  void add(std::span<const double> numbers);
  /** To be called after the last one. */
  void finish();

private:
  void begin(std::int64_t black, bool bytes);
  bool fits(std::span<const double> numbers) const;
  void append(std::span<const double> numbers);
  void drop();

  RawMeshBuilder& Builder;
  ColumnOf Owners;
  std::optional<ImportColumn> Column;
  bool Bytes = false;
  std::size_t Components = 0; ///< of the first; 0: none
  std::int64_t Owned = 0;     ///< vertices or faces so far
  bool Dropped = false;
};

} // namespace smg
