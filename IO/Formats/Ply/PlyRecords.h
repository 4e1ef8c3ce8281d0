// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The first lines of the header of a binary PLY file in this machine's byte order. */
std::string plyFormatLines();

/** An element of a PLY file whose records all have the same size: its part of the header, and its
 * records, made from columns. Columns of 64-bit integers become double. */
class PlyRecords
{
public:
  /** The element `name` with `count` records. */
  PlyRecords(const std::string& name, std::int64_t count);

  /** Adds the properties of a column (see writePly); returns their position in the record, or -1,
   * without adding anything, if a property already has that name. */
  std::ptrdiff_t add(const ColumnSpec& spec);
  /** Adds `bytes` bytes described by the line `property`. */
  std::ptrdiff_t add(const std::string& property, std::size_t bytes);

  const std::string& header() const { return this->Header; }
  std::size_t recordBytes() const { return this->RecordBytes; }

  /** Makes `count` records, whose fields must be filled. */
  void begin(std::size_t count);
  /** Fills in tuples of `bytes` bytes, one per record, at a position of the record. */
  void fill(std::ptrdiff_t place, std::span<const std::byte> tuples, std::size_t bytes);
  /** Fills in a column that was added at this position; returns whether a value was rounded. */
  bool fill(std::ptrdiff_t place, const Column& column);
  std::span<const std::byte> records() const { return this->Records; }

private:
  std::string Header;
  std::vector<std::string> Names;
  std::size_t RecordBytes = 0;
  std::vector<std::byte> Records;
  std::vector<double> Doubles;
};

} // namespace smg
