// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Ply/WritePly.h"
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

  /** Adds the coordinates x, y and z. */
  void addPositions(bool isDouble);
  /** Adds `bytes` bytes described by the line `property`. */
  void add(const std::string& property, std::size_t bytes);
  /** Adds the properties of columns, named as writePly() says. Other names are noted. */
  void add(const std::vector<ColumnSpec>& columns, WrittenPly& written);

  const std::string& header() const { return this->Header; }
  std::size_t recordBytes() const { return this->RecordBytes; }

  /** Makes `count` records, whose fields must be filled. */
  void begin(std::size_t count);
  /** Fills in the coordinates, which are the first properties. */
  void fillPositions(std::span<const double> positions);
  /** Fills in tuples of `bytes` bytes, one per record, at a position of the record. */
  void fill(std::ptrdiff_t place, std::span<const std::byte> tuples, std::size_t bytes);
  /** Fills in the columns that were added. Rounded values are noted. */
  void fill(const std::vector<Column>& columns, WrittenPly& written);
  std::span<const std::byte> records() const { return this->Records; }

private:
  void addProperty(const std::string& property, std::size_t bytes);
  bool areFree(const std::vector<std::string>& names) const;
  bool fill(std::ptrdiff_t place, const Column& column);

  std::string Header;
  std::vector<std::string> Names;
  std::size_t RecordBytes = 0;
  std::vector<std::ptrdiff_t> Places; ///< of each column in the record
  bool DoublePositions = true;
  std::vector<std::byte> Records;
  std::vector<float> Single;
  std::vector<double> Doubles;
};

} // namespace smg
