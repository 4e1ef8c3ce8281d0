// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>

namespace smg
{

/** A property that has an effect in some modes only. */
struct ModeProperty
{
  const char* name;
  bool isSet;         ///< to another value than its default
  bool isUsed;        ///< in the chosen mode
  const char* remedy; ///< as "set Region to Ids"
};

/** A sentence about the first of them that is set and not used; "" if there is none. */
inline std::string unusedProperty(std::initializer_list<ModeProperty> properties)
{
  for (const ModeProperty& property : properties)
  {
    if (property.isSet && !property.isUsed)
    {
      return std::string(property.name) + " has no effect: " + property.remedy +
             ", or give it its default again.";
    }
  }
  return "";
}

/** Whether a property names an array; "None" is what ParaView offers for none. */
inline bool namesArray(const std::string& name)
{
  return !name.empty() && name != "None";
}

} // namespace smg
