// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/StreamingMeshProperties.h"

#include "IO/Jobs/JobProperties.h"

#include "vtkObject.h"

#include <cstddef>
#include <utility>

namespace smg
{

void setText(vtkObject& filter, std::string& member, const char* text)
{
  const std::string given = text ? text : "";
  if (std::exchange(member, given) != given)
  {
    filter.Modified();
  }
}

void setOption(vtkObject& filter, JobProperties& options, const char* property, double number)
{
  if (options.set(property, number))
  {
    filter.Modified();
  }
}

void setOption(vtkObject& filter, JobProperties& options, const char* property, const char* text)
{
  if (options.set(property, std::string(text ? text : "")))
  {
    filter.Modified();
  }
}

void addName(vtkObject& filter, std::vector<std::string>& names, const char* name)
{
  if (name && *name)
  {
    names.emplace_back(name);
    filter.Modified();
  }
}

void removeNames(vtkObject& filter, std::vector<std::string>& names)
{
  if (!names.empty())
  {
    names.clear();
    filter.Modified();
  }
}

const char* textOf(const std::string& member)
{
  return member.empty() ? nullptr : member.c_str();
}

double numberOf(const JobProperties& options, const char* property)
{
  return options.number(property);
}

const char* textOf(const JobProperties& options, const char* property)
{
  return textOf(options.text(property));
}

const char* nameOf(const std::vector<std::string>& names, int number)
{
  return number >= 0 && number < static_cast<int>(names.size())
           ? names[static_cast<std::size_t>(number)].c_str()
           : nullptr;
}

} // namespace smg
