// SPDX-License-Identifier: BSD-3-Clause
#include "ArrayColors.h"

#include "vtkSMSettings.h"

#include <string>

namespace smg
{
namespace
{

/** Of ParaView's settings; those that a user has saved have a higher priority. */
constexpr double Priority = 1.0;

/** Two colours for an array with the values 0 and 1; a third one for 2, if that has a name. */
std::string entry(const std::string& array, const std::string& names)
{
  return "\"" + array + R"(": {"PVLookupTable": {"IndexedLookup": 1, "Annotations": [)" + names +
         R"(], "IndexedColors": [0.86, 0.86, 0.86, 0.85, 0.33, 0.1, 0.45, 0.1, 0.45]}})";
}

} // namespace

void colorArrays()
{
  std::string tables = entry("HandleMask", R"("0", "free", "1", "held", "2", "held by several")");
  tables += ", " + entry("RegionMask", R"("0", "outside", "1", "inside")");
  for (int k = 1; k < 10; ++k)
  {
    tables += ", " + entry("Condition" + std::to_string(k), R"("0", "outside", "1", "inside")");
  }
  // The range of colours is that of the finite numbers.
  tables +=
    R"(, "Distance": {"PVLookupTable": {"UseAboveRangeColor": 1, "AboveRangeColor": [0.4, 0.4, 0.4]}})";
  vtkSMSettings::GetInstance()->AddCollectionFromString(
    R"({"array_lookup_tables": {)" + tables + "}}", Priority);
}

} // namespace smg
