// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/Base64.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <lz4.h>
#include <lzma.h>
#include <zlib.h>

namespace smg::testing
{

/** How the arrays of a file are stored. */
enum class Way
{
  Ascii,
  Inline,
  AppendedBase64,
  AppendedRaw
};

/** Writes .vtu and .vtp files in all variants. */
class VtkXmlWriter
{
public:
  Way way = Way::Ascii;
  bool bigEndian = false, wideHeader = false;
  std::string compressor; ///< class of VTK; empty: none

  /** A DataArray of numbers of a type, such as "Int32". */
  template <class T>
  std::string array(const std::string& name, const std::string& type, const std::vector<T>& values,
    int components = 1)
  {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name +
                      "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"";
    if (this->way == Way::Ascii)
    {
      tag += "ascii\">\n";
      for (const T value : values)
      {
        tag += exact(static_cast<double>(value)) + ' ';
      }
      return tag + "\n</DataArray>\n";
    }
    std::string bytes;
    for (const T value : values)
    {
      bytes += this->bytesOf(value);
    }
    const std::string data = this->encoded(bytes);
    if (this->way == Way::Inline)
    {
      return tag + "binary\">\n  " + data + "\n</DataArray>\n";
    }
    tag += "appended\" offset=\"" + std::to_string(this->Appended.size()) + "\"/>\n";
    this->Appended += data;
    return tag;
  }

  std::string file(const std::string& kind, const std::string& content) const
  {
    std::string text = "<?xml version=\"1.0\"?>\n<!-- > -->\n<VTKFile type=\"" + kind +
                       "\" byte_order=\"" + (this->bigEndian ? "BigEndian" : "LittleEndian") +
                       "\" header_type=\"" + (this->wideHeader ? "UInt64" : "UInt32") + "\"";
    text += this->compressor.empty() ? "" : " compressor=\"" + this->compressor + "\"";
    text += ">\n<" + kind + ">\n" + content + "</" + kind + ">\n";
    if (!this->Appended.empty())
    {
      text += "<AppendedData encoding=\"";
      text += this->way == Way::AppendedRaw ? "raw" : "base64";
      text += "\">\n _" + this->Appended + "\n</AppendedData>\n";
    }
    return text + "</VTKFile>\n";
  }

private:
  template <class T>
  std::string bytesOf(T value) const
  {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
    if (this->bigEndian != (std::endian::native == std::endian::big))
    {
      std::ranges::reverse(bytes);
    }
    return bytes;
  }

  std::string number(std::size_t value) const
  {
    return this->wideHeader ? this->bytesOf(static_cast<std::uint64_t>(value))
                            : this->bytesOf(static_cast<std::uint32_t>(value));
  }

  std::string text(const std::string& bytes) const
  {
    if (this->way == Way::AppendedRaw)
    {
      return bytes;
    }
    std::string text;
    Base64Encoder encoder;
    encoder.append(std::as_bytes(std::span(bytes)), text);
    encoder.finish(text);
    return text;
  }

  std::string compressed(const std::string& block) const
  {
    std::string to(block.size() + 1000, '\0');
    if (this->compressor == "vtkLZ4DataCompressor")
    {
      to.resize(static_cast<std::size_t>(LZ4_compress_default(
        block.data(), to.data(), static_cast<int>(block.size()), static_cast<int>(to.size()))));
      return to;
    }
    if (this->compressor == "vtkLZMADataCompressor")
    {
      std::size_t written = 0;
      EXPECT_EQ(lzma_easy_buffer_encode(5, LZMA_CHECK_CRC32, nullptr,
                  reinterpret_cast<const std::uint8_t*>(block.data()), block.size(),
                  reinterpret_cast<std::uint8_t*>(to.data()), &written, to.size()),
        LZMA_OK);
      to.resize(written);
      return to;
    }
    uLongf size = to.size();
    EXPECT_EQ(::compress(reinterpret_cast<Bytef*>(to.data()), &size,
                reinterpret_cast<const Bytef*>(block.data()), block.size()),
      Z_OK);
    to.resize(size);
    return to;
  }

  std::string encoded(const std::string& bytes) const
  {
    if (this->compressor.empty())
    {
      return this->text(this->number(bytes.size()) + bytes);
    }
    constexpr std::size_t BlockBytes = 40;
    const std::size_t blocks = (bytes.size() + BlockBytes - 1) / BlockBytes;
    std::string header =
      this->number(blocks) + this->number(BlockBytes) + this->number(bytes.size() % BlockBytes);
    std::string data;
    for (std::size_t i = 0; i < blocks; ++i)
    {
      const std::string block = this->compressed(bytes.substr(i * BlockBytes, BlockBytes));
      header += this->number(block.size());
      data += block;
    }
    return this->text(header) + this->text(data);
  }

  std::string Appended;
};

} // namespace smg::testing
