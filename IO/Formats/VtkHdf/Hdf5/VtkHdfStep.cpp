// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfStep.h"

#include "IO/Files/InQuotes.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfRoot.h"

#include <algorithm>
#include <vector>

namespace smg
{

namespace
{

const std::string Group = VtkHdfRoot + "Steps";

} // namespace

VtkHdfStep::VtkHdfStep(const Hdf5File& file, std::int64_t step)
  : File(file)
  , Step(step)
{
  const std::int64_t said = file.exists(Group) ? file.integer(Group, "NSteps").value_or(0) : 0;
  this->Steps = std::clamp<std::int64_t>(said, 0, VtkHdfMostRows);
  if (step < 0 || step >= std::max<std::int64_t>(this->Steps, 1))
  {
    file.fail(this->Steps > 0
                ? "there is no time step " + std::to_string(step) + ": the file has " +
                    std::to_string(this->Steps) + ", counted from 0 (option --time-step)"
                : "the file has no time steps (option --time-step)");
  }
}

std::int64_t VtkHdfStep::number(
  const std::string& name, std::int64_t otherwise, std::size_t column, std::size_t columns) const
{
  const std::string dataset = Group + '/' + name;
  if (this->Steps == 0 || !this->File.exists(dataset))
  {
    return otherwise;
  }
  const std::vector<std::int64_t> values = this->File.integers(dataset);
  const std::size_t at = static_cast<std::size_t>(this->Step) * columns + column;
  if (at >= values.size() || values[at] < 0 || values[at] > VtkHdfMostRows)
  {
    this->File.fail(
      "the dataset " + inQuotes(dataset) + " is too short, or its numbers cannot be right");
  }
  return values[at];
}

VtkHdfStep::Partitions VtkHdfStep::partitions(std::int64_t all) const
{
  Partitions own;
  own.first = this->number("PartOffsets", 0);
  own.count = this->number("NumberOfParts", this->nextPartition(own.first, all) - own.first);
  if (all == 0 || own.first > all || own.count > all - own.first)
  {
    this->File.fail("the file has " + std::to_string(all) + " partitions, fewer than it says");
  }
  return own;
}

/** The begin of the next time step's partitions after those of this one, or the end. */
std::int64_t VtkHdfStep::nextPartition(std::int64_t first, std::int64_t all) const
{
  const std::string offsets = Group + "/PartOffsets";
  std::int64_t next = all;
  if (this->Steps > 1 && this->File.exists(offsets))
  {
    for (const std::int64_t offset : this->File.integers(offsets))
    {
      next = offset > first ? std::min(next, offset) : next;
    }
  }
  return next;
}

} // namespace smg
