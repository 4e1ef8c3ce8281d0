// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

/** The header of an OFF file. */
struct OffHeader
{
  std::int64_t vertices = 0, faces = 0;
  /** The values after the coordinates of a vertex, according to the keyword. */
  bool normals = false, colors = false, textureCoordinates = false;
  bool binary = false;
  std::size_t body = 0; ///< of a binary file: the byte at which its vertices begin
};

/** Reads the counts of a binary file, from byte `header.body` on, and advances past them. Throws
 * Error if the file is too short for them. */
void readBinaryOffCounts(InputFile& file, OffHeader& header);

/**
 * Reads vertices and faces of a binary file: 32-bit numbers, most significant byte first, as
 * Geomview writes them. A vertex has floats in the order of the keyword's letters, a colour four; a
 * face has its number of corners, these, and the number of its colour's floats, and these.
 */
void readBinaryOff(InputFile& file, const OffHeader& header, RawMeshBuilder& builder);

/** The numbers up to the end of the line, or to the first token that is not a number. */
class LineNumbers
{
public:
  void read(TextScanner& scanner)
  {
    this->Count = 0;
    for (std::string_view token = scanner.tokenInLine(); !token.empty() && this->Count < MaxNumbers;
         token = scanner.tokenInLine())
    {
      const std::optional<double> number = parseFinite(token);
      if (!number)
      {
        return;
      }
      this->Numbers[this->Count++] = *number;
    }
  }
  std::span<const double> all() const { return std::span(this->Numbers).first(this->Count); }

private:
  /** More than the values after the coordinates of a vertex, or after a face. */
  static constexpr std::size_t MaxNumbers = 16;

  std::array<double, MaxNumbers> Numbers{};
  std::size_t Count = 0;
};

/** The columns of the values after the coordinates: normals, colours, texture coordinates. */
class OffAttributes
{
public:
  OffAttributes(const OffHeader& header, RawMeshBuilder& builder)
    : Header(header)
    , Builder(builder)
    , Colors(builder, ColumnOf::Vertices)
  {
  }

  bool any() const
  {
    return this->Header.normals || this->Header.colors || this->Header.textureCoordinates;
  }

  void add(std::span<const double> numbers)
  {
    if (!this->Begun)
    {
      this->begin(numbers.size());
    }
    if (this->Used == 0)
    {
      return;
    }
    if (numbers.size() != this->Used)
    {
      throw MeshError("a vertex has " + std::to_string(numbers.size()) +
                      " numbers behind its coordinates, those before it have " +
                      std::to_string(this->Used));
    }
    if (this->Normals)
    {
      this->append(numbers.first(3), *this->Normals);
      numbers = numbers.subspan(3);
    }
    if (this->Texture)
    {
      this->append(numbers.last(2), *this->Texture);
      numbers = numbers.first(numbers.size() - 2);
    }
    this->Colors.add(numbers);
  }

  /** To be called after the last vertex. */
  void finish() { this->Colors.finish(); }

private:
  /** Of normals and texture coordinates: a text may have been written of doubles. */
  ScalarType type() const
  {
    return this->Header.binary ? ScalarType::Float32 : ScalarType::Float64;
  }
  void append(std::span<const double> numbers, ImportColumn& column) const
  {
    this->Header.binary ? appendAs<float>(numbers, column) : appendAs<double>(numbers, column);
  }
  /** If the vertices lack the values of the keyword, the columns are omitted. */
  void begin(std::size_t numbers)
  {
    this->Begun = true;
    const std::size_t others =
      (this->Header.normals ? 3 : 0) + (this->Header.textureCoordinates ? 2 : 0);
    const std::size_t colors = numbers - std::min(others, numbers);
    if (numbers < others || (this->Header.colors ? colors != 3 && colors != 4 : colors != 0))
    {
      this->Builder.note("The vertices have not the numbers that the keyword of the file promises "
                         "(NOFF: normals, COFF: colours, STOFF: texture coordinates): all but "
                         "their coordinates is left out.");
      return;
    }
    this->Used = numbers;
    if (this->Header.normals)
    {
      this->Normals.emplace(
        this->Builder, ColumnOf::Vertices, ColumnSpec{ NormalsName, this->type(), 3 });
    }
    if (this->Header.textureCoordinates)
    {
      this->Texture.emplace(
        this->Builder, ColumnOf::Vertices, ColumnSpec{ TextureCoordinatesName, this->type(), 2 });
    }
  }

  OffHeader Header;
  RawMeshBuilder& Builder;
  TextColors Colors;
  std::optional<ImportColumn> Normals, Texture;
  bool Begun = false;
  std::size_t Used = 0; ///< values after the coordinates; 0: omitted
};

} // namespace smg
