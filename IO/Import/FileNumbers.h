// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace smg
{

class RawMeshBuilder;

/**
 * The numbers that a file gives its nodes or elements, by which it refers to them: any numbers,
 * usually 1, 2, 3 ... Consecutive ones are not stored; others are sorted out of core, and corners
 * are numbers of the file until a Relabelling replaces these.
 */
class FileNumbers
{
public:
  /** `what` they are of, for errors: "nodes". Elements that come before all nodes are known have
   * corners that count `fromOne`; then smaller numbers are an error. */
  FileNumbers(Workspace& workspace, std::string what, bool fromOne = false)
    : Space(workspace)
    , What(std::move(what))
    , FromOne(fromOne)
  {
  }

  /** Adds the number of the next node or element. Throws MeshError if it is too small. */
  void add(std::int64_t number)
  {
    if (!this->Numbers && number >= this->First &&
        this->distance(number) == static_cast<std::uint64_t>(this->Count))
    {
      ++this->Count;
      return;
    }
    this->addOther(number);
  }
  std::int64_t count() const { return this->Count; }
  /** The largest number so far; 0: there is none. */
  std::int64_t largest() const
  {
    return this->Numbers ? this->Largest : this->Count == 0 ? 0 : this->First + (this->Count - 1);
  }

  /** To be called after the last one. Throws MeshError if two have the same number, or their range
   * exceeds 32 bits. */
  void finish();

  /** After finish(): passes the place of each of these numbers, in the order of the file, to
   * `take`; NoIndex: there is none of that number. Those in the file are less by the first number.
   */
  template <class Take>
  void find(RecordFile<std::uint32_t>& numbers, Take&& take)
  {
    numbers.close();
    if (this->Places)
    {
      this->Places->apply(numbers, 1, [&](std::span<const std::uint32_t> p) { take(p[0]); });
      return;
    }
    RecordFile<std::uint32_t>::Reader reader(numbers);
    for (std::uint32_t place = 0; reader.next(place);)
    {
      take(place < this->Count ? place : NoIndex);
    }
  }

  /** After finish(), in the end: passes what the numbers are as corners to the builder. */
  void numberCorners(RawMeshBuilder& builder);

private:
  struct Numbered
  {
    std::int64_t number;
    std::int64_t place;
    bool operator<(const Numbered& other) const
    {
      return this->number != other.number ? this->number < other.number : this->place < other.place;
    }
  };

  /** From the first number, without overflow. */
  std::uint64_t distance(std::int64_t number) const
  {
    return static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(this->First);
  }
  void addOther(std::int64_t number);
  void sort();

  Workspace& Space;
  std::string What;
  bool FromOne;
  std::int64_t Count = 0;
  std::int64_t First = 1; ///< number of the first one; after finish() the least number, or 1
  std::int64_t Least = std::numeric_limits<std::int64_t>::max();
  std::int64_t Largest = std::numeric_limits<std::int64_t>::min();
  std::uint64_t Range = 0; ///< numbers from First to the largest one
  std::optional<ExternalSort<Numbered>> Numbers;
  std::optional<Relabelling> Places;
};

} // namespace smg
