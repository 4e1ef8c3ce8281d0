// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/Job.h"
#include "smg/Export.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The property of a filter in VTK that is an option, as "KeepVolume"; empty: none. */
SMG_EXPORT std::string propertyOf(const JobOption& option);
/** The properties that are options of some job, by the options of its command, as "--max-cycles".
 */
SMG_EXPORT const std::map<std::string, std::string, std::less<>>& propertiesOfOptions();

/**
 * Options of a job as the properties of a filter in VTK: numbers, of which flags and choices are
 * some, and texts, which name columns and parts of the mesh. Any number may be set, and check()
 * refuses those that the table of the job does not allow. What is optional is 0 for none; so is
 * the first one of choices that have no default.
 */
class SMG_EXPORT JobProperties
{
public:
  /** With the defaults of a kind of job, and with the numbers of any job that solves equations. */
  explicit JobProperties(std::string_view kind);
  ~JobProperties();
  JobProperties(const JobProperties&) = delete;
  JobProperties& operator=(const JobProperties&) = delete;

  double number(std::string_view property) const;
  const std::string& text(std::string_view property) const;
  /** Both return whether it was another one. */
  bool set(std::string_view property, double number);
  bool set(std::string_view property, const std::string& text);

  /** Throws Error, which names the property, if a number is out of its range. */
  void check() const;
  /** Sets the numbers and columns of a job of this kind; "None", as ParaView says, is no column. */
  void applyTo(Job& job) const;
  /** A line for each, after `indent`, which can be written to the stream. */
  template <class Stream, class Indent>
  void print(Stream& os, const Indent& indent) const
  {
    for (const std::string& line : this->lines())
    {
      os << indent << line << '\n';
    }
  }

private:
  struct Row;

  /** As "Sweeps: 2". */
  std::vector<std::string> lines() const;
  /** The place among the rows; their number: there is none. */
  std::size_t placeOf(std::string_view property) const;

  std::vector<Row> Rows;
};

} // namespace smg
