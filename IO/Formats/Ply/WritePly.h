// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** The changes to the columns of a mesh written as PLY. */
struct WrittenPly
{
  /** Columns with another name in the file, and that name. */
  std::vector<std::pair<std::string, std::string>> renamedColumns;
  /** Columns of 64-bit integers with values beyond 2^53, which were rounded. */
  std::vector<std::string> roundedColumns;
};

/**
 * Writes a mesh stream of triangles, with known numbers of vertices and cells, as one binary
 * PLY file: the vertices in stream order with coordinates in the precision of the stream, then the
 * faces, as `list uchar int vertex_indices`. Data are written as they arrive, in the memory of a
 * few blocks.
 *
 * Columns become properties of the vertices or faces, named so that importMesh() restores the same
 * columns: `Normals` of 3 components nx, ny, nz; `Colors` of 3 or 4 red, green, blue, alpha; a
 * column of one component its own name, and one of several NAME_0, NAME_1 ..., which come back as
 * columns of their own. What is no visible ASCII character in a name becomes an underscore, and a
 * name whose property another column or the mesh has is followed by _1, _2 ...; columns that need
 * no other name keep theirs. PLY has no 64-bit integers: they are written, and come back, as
 * double, which is exact up to 2^53. So convert() takes the `OriginalId` of a PLY file for an
 * attribute (see there): its own are the places in the PLY file.
 * @throws Error if checkPlyVertices() does, the stream has not the counts that it says, or the file
 * cannot be written; Cancelled. Nothing is left of the file then.
 */
WrittenPly writePly(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress = {});

/** Notes for the user, a sentence per column. */
std::vector<std::string> notesOn(const WrittenPly& written);

/** Throws Error if there are more vertices than PLY has numbers for. */
void checkPlyVertices(const std::filesystem::path& path, std::int64_t vertices);

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
