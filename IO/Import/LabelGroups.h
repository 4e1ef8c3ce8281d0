// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>

namespace smg
{

/** Numbers that a file gives vertices or elements in a column. They are labels of groups if they
 * are integers, and few; otherwise they number or measure something. 0 is no group. */
class LabelGroups
{
public:
  static constexpr std::size_t Most = 1024;

  void add(std::int64_t label)
  {
    if (label != this->Last && !this->AreOther)
    {
      this->Last = label;
      this->Labels.insert(label);
      this->AreOther = this->Labels.size() > Most;
    }
  }
  void add(double label)
  {
    constexpr double Limit = 1e15;
    const bool isInteger = std::abs(label) < Limit && label == std::floor(label);
    this->AreOther = this->AreOther || !isInteger;
    this->add(isInteger ? static_cast<std::int64_t>(label) : 0);
  }

  /** When the column is closed: passes the number of each tuple that is in a group, and its label,
   * the last of `components` values of type T. */
  template <class T, class Take>
  void forEach(const ImportColumn& column, std::size_t components, Take&& take) const
  {
    if (!column.exists() || this->AreOther || this->Labels.empty())
    {
      return;
    }
    BucketFile::Reader reader(column.tuples());
    T value{};
    for (std::int64_t tuple = 0;; ++tuple)
    {
      for (std::size_t k = 0; k < components; ++k)
      {
        if (!reader.get(value))
        {
          return;
        }
      }
      if (value != 0)
      {
        take(tuple, static_cast<std::int64_t>(value));
      }
    }
  }

  /** The same for integers of vertices: puts them into groups of vertices. Those of the file count
   * from `first`. */
  void groupVertices(RawMeshBuilder& builder, const ImportColumn& column, std::int64_t first) const
  {
    this->forEach<std::int64_t>(column, 1,
      [&](std::int64_t vertex, std::int64_t label)
      {
        const std::int64_t number = first + vertex;
        builder.grouped(0, std::span(&number, 1), builder.groups().numbered(0, label));
      });
  }

private:
  std::set<std::int64_t> Labels;
  std::int64_t Last = 0;
  bool AreOther = false;
};

} // namespace smg
