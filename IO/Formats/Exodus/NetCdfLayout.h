// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * The header of a classic netCDF file that is to be written, and the places of its variables, one
 * after the other in the order in which they are added, those of records last. A file of 64-bit
 * offsets (CDF-2), unless a variable or a dimension has more than 31 bits (CDF-5).
 */
class NetCdfLayout
{
public:
  /** By their numbers in files. */
  enum class Type : std::int32_t
  {
    Char = 2,
    Int = 4,
    Float = 5,
    Double = 6,
    Int64 = 10
  };
  static std::int64_t bytesOf(Type type);

  /** Adds a dimension; returns its number. */
  int dimension(const std::string& name, std::int64_t size);
  /** The same of the dimension of the records, of which there are so many. */
  int records(const std::string& name, std::int64_t count);
  /** Attributes of the file. */
  void attribute(const std::string& name, const std::string& text);
  void attribute(const std::string& name, std::int32_t value);
  void attribute(const std::string& name, float value);

  using Texts = std::vector<std::pair<std::string, std::string>>;
  /** Adds a variable with these attributes; returns its number. */
  int variable(const std::string& name, Type type, const std::vector<int>& dimensions,
    const Texts& attributes = {});
  std::size_t variables() const { return this->Variables.size(); }
  Type typeOf(int variable) const { return this->Variables[std::size_t(variable)].type; }

  /** After the last variable: gives all their places. */
  void place();
  /** Where a variable begins in the file; of one of records, the first. */
  std::int64_t beginOf(int variable) const { return this->Variables[std::size_t(variable)].begin; }
  /** The bytes of the header, at the beginning of the file. */
  std::vector<std::byte> header() const;

private:
  struct Dimension
  {
    std::string name;
    std::int64_t size;
  };
  struct Attribute
  {
    std::string name;
    Type type;
    std::int64_t count;
    std::vector<std::byte> bytes; ///< as in the file
  };
  struct Variable
  {
    std::string name;
    Type type;
    std::vector<int> dimensions;
    std::vector<Attribute> attributes;
    std::int64_t bytes = 0, begin = 0; ///< of a record
    bool isOfRecords = false;
  };
  class Packer;

  static Attribute textAttribute(const std::string& name, const std::string& text);

  std::vector<Dimension> Dimensions;
  std::vector<Attribute> Attributes;
  std::vector<Variable> Variables;
  int RecordDimension = -1;
  std::int64_t Records = 0;
  bool IsLarge = false;
};

} // namespace smg
