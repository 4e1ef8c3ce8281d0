// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Report.h"

#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/ReportFields.h"

#include <cstdio>

// The report as JSON: the text that --report writes, the filters return and scripts read.
// ReportFields.h lists its entries, docs/solve.md describes them. JSON has no NaN: numbers that are
// not known are written as null.

namespace smg
{

/** The measure says what an entry of a tag has. */
nlohmann::ordered_json shownJson(const Report::Areas& areas)
{
  const char* const measure = areas.isVolume ? "volume" : "area";
  nlohmann::ordered_json out{ { "measure", measure }, { "cells", areas.cells },
    { "total", areas.total } };
  if (areas.hasTags)
  {
    out["by_tag"] = nlohmann::ordered_json::array();
  }
  for (const Report::Area& part : areas.by_tag)
  {
    out["by_tag"].push_back(
      { { "tag", part.tag }, { "cells", part.cells }, { measure, part.area } });
  }
  return out;
}

/** Without an inverted cell there is no worst one. */
nlohmann::ordered_json shownJson(const Report::Inverted& inverted)
{
  nlohmann::ordered_json out{ { "cells", inverted.cells }, { "share", inverted.share } };
  if (inverted.cells > 0)
  {
    out["worst"] = { { "cell", inverted.worst }, { "ratio", inverted.ratio },
      { "place", inverted.place } };
  }
  return out;
}

std::string Report::json(int indent) const
{
  return jsonOf<false>(*this).dump(indent);
}

std::vector<std::uint8_t> packedReport(const Report& report)
{
  return packed(report);
}

Report unpackedReport(std::span<const std::uint8_t> bytes)
{
  Report report;
  unpack(report, bytes);
  return report;
}

std::string Report::residualText() const
{
  if (this->residuals.empty())
  {
    return "the values already are the solution";
  }
  char number[32];
  std::snprintf(number, sizeof number, "%.3g", this->residual());
  return std::string("relative residual ") + number +
         (this->relative_to.empty() ? "" : ", to that of " + this->relative_to);
}

} // namespace smg
