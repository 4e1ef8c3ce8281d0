// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/ByteOrder.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Exodus/NetCdfLayout.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Appends to many variables of a file at once, each at its place. */
class VariableOutput
{
public:
  explicit VariableOutput(const std::filesystem::path& path)
    : File(path)
  {
  }

  /** Begins a variable here; returns its number. */
  std::size_t begin(std::int64_t at, NetCdfLayout::Type type)
  {
    this->Variables.push_back({ at, type, {} });
    return this->Variables.size() - 1;
  }

  void put(std::size_t variable, double value)
  {
    const NetCdfLayout::Type type = this->Variables[variable].type;
    type == NetCdfLayout::Type::Float    ? this->append(variable, static_cast<float>(value))
    : type == NetCdfLayout::Type::Double ? this->append(variable, value)
                                         : this->put(variable, static_cast<std::int64_t>(value));
  }
  void put(std::size_t variable, std::int64_t value)
  {
    this->Variables[variable].type == NetCdfLayout::Type::Int64
      ? this->append(variable, value)
      : this->append(variable, static_cast<std::int32_t>(value));
  }
  /** A row of so many characters. */
  void put(std::size_t variable, std::string text, std::size_t length)
  {
    text.resize(length);
    for (const char c : text)
    {
      this->append(variable, c);
    }
  }

  void finish(std::span<const std::byte> header)
  {
    this->flush();
    this->File.write(0, header);
    this->File.finish();
  }

private:
  struct Variable
  {
    std::int64_t at;
    NetCdfLayout::Type type;
    std::vector<std::byte> bytes;
  };

  template <class T>
  void append(std::size_t variable, T value)
  {
    std::vector<std::byte>& bytes = this->Variables[variable].bytes;
    const auto added = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), added.begin(), added.end());
    toByteOrder(std::endian::big, std::span(bytes).last(sizeof(T)), sizeof(T));
    this->Waiting += sizeof(T);
    constexpr std::size_t Most = std::size_t(4) << 20;
    if (this->Waiting > Most)
    {
      this->flush();
    }
  }

  void flush()
  {
    for (Variable& variable : this->Variables)
    {
      if (!variable.bytes.empty())
      {
        this->File.write(variable.at, variable.bytes);
        variable.at += std::ssize(variable.bytes);
        variable.bytes = {};
      }
    }
    this->Waiting = 0;
  }

  PositionedFile File;
  std::vector<Variable> Variables;
  std::size_t Waiting = 0;
};

} // namespace smg
