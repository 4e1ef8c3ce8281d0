// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/IO/MeshText.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{

using Numbers = std::vector<std::int64_t>;

/** A kind of .msh file. */
struct GmshVariant
{
  int version = 2; ///< 2.2 or 4.1
  bool binary = false;
  bool swapped = false; ///< the byte order opposite to this machine's
};
inline constexpr std::array<GmshVariant, 6> GmshVariants{ { { 2, false, false },
  { 4, false, false }, { 2, true, false }, { 2, true, true }, { 4, true, false },
  { 4, true, true } } };

/** An element of a .msh file. */
struct GmshElement
{
  int type;
  Numbers nodes; ///< tags
};

/** Writes .msh files of all variants. */
class GmshWriter
{
public:
  explicit GmshWriter(GmshVariant variant)
    : Kind(variant)
  {
    this->Bytes = std::string("$MeshFormat\n") + (variant.version == 2 ? "2.2 " : "4.1 ") +
                  (variant.binary ? "1" : "0") + " 8\n";
    if (variant.binary)
    {
      this->integer(1);
      this->Bytes += '\n';
    }
    this->Bytes += "$EndMeshFormat\n";
  }

  void text(const std::string& bytes) { this->Bytes += bytes; }
  void integer(std::int64_t value) { this->number(static_cast<std::int32_t>(value)); }
  void size(std::int64_t value) { this->number(value); }
  void real(double value) { this->number(value); }
  void endRow() { this->Bytes += this->Kind.binary ? "" : "\n"; }

  void nodes(const Numbers& tags, const std::vector<std::array<double, 3>>& points)
  {
    this->text("$Nodes\n");
    if (this->Kind.version == 2)
    {
      this->text(std::to_string(tags.size()) + '\n');
      for (std::size_t i = 0; i < tags.size(); ++i)
      {
        this->integer(tags[i]);
        this->point(points[i]);
      }
    }
    else
    {
      this->head({ 1, std::int64_t(tags.size()), 1, 99 });
      this->block(3, 1, 0, std::int64_t(tags.size()));
      for (const std::int64_t tag : tags)
      {
        this->size(tag);
        this->endRow();
      }
      for (const auto& point : points)
      {
        this->point(point);
      }
    }
    this->end("$EndNodes");
  }

  void elements(const std::vector<GmshElement>& elements)
  {
    this->text("$Elements\n");
    const auto count = static_cast<std::int64_t>(elements.size());
    this->Kind.version == 2 ? this->text(std::to_string(count) + '\n')
                            : this->head({ count, count, 1, count });
    std::int64_t tag = 0;
    for (const GmshElement& element : elements)
    {
      this->element(element, ++tag);
    }
    this->end("$EndElements");
  }

  const std::string& bytes() const { return this->Bytes; }

private:
  template <class T>
  void number(T value)
  {
    if (!this->Kind.binary)
    {
      this->Bytes += exact(static_cast<double>(value)) + ' ';
      return;
    }
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (this->Kind.swapped)
    {
      std::ranges::reverse(raw);
    }
    this->Bytes.append(raw.data(), sizeof(T));
  }

  void head(const Numbers& sizes)
  {
    for (const std::int64_t size : sizes)
    {
      this->size(size);
    }
    this->endRow();
  }
  void block(int a, int b, int c, std::int64_t count)
  {
    this->integer(a);
    this->integer(b);
    this->integer(c);
    this->size(count);
    this->endRow();
  }
  void point(const std::array<double, 3>& point)
  {
    for (const double coordinate : point)
    {
      this->real(coordinate);
    }
    this->endRow();
  }
  void element(const GmshElement& element, std::int64_t tag)
  {
    if (this->Kind.version == 4)
    {
      this->block(3, 1, element.type, 1);
      this->size(tag);
      for (const std::int64_t node : element.nodes)
      {
        this->size(node);
      }
      this->endRow();
      return;
    }
    // A header, which is a group of one element in a binary file; two tags.
    const std::int64_t binaryHead[] = { element.type, 1, 2, tag };
    const std::int64_t textHead[] = { tag, element.type, 2 };
    for (const std::int64_t number : this->Kind.binary ? std::span<const std::int64_t>(binaryHead)
                                                       : std::span<const std::int64_t>(textHead))
    {
      this->integer(number);
    }
    this->integer(17);
    this->integer(18);
    for (const std::int64_t node : element.nodes)
    {
      this->integer(node);
    }
    this->endRow();
  }
  void end(const std::string& line)
  {
    this->Bytes += (this->Kind.binary ? "\n" : "") + line + '\n';
  }

  GmshVariant Kind;
  std::string Bytes;
};

} // namespace smg::testing
