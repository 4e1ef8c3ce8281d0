// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCommand.h"

#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/AreaJob.h"
#include "Solver/Core/Text.h"

#include <cstdio>
#include <ranges>

namespace
{

class AreaCommand : public MeshCommand
{
public:
  AreaCommand()
    : MeshCommand("measuring")
  {
  }

  void addOptions(CLI::App& command)
  {
    this->addFiles(
      command, "The mesh with the share of each vertex, the column Area or Volume: " +
                 smg::suffixList(smg::FormatUse::WriteColumns, "or") +
                 " in stream order; of a mesh file IN, " +
                 smg::suffixList(smg::FormatUse::RestoreColumns, "and") +
                 " in the order of IN, unless that has a column OriginalId or points are welded");
    this->addJobOptions(command);
    this->addInputAndCommon(command);
  }

protected:
  smg::AreaJob& job() override { return this->Job; }

  void print(const smg::Report& report) const override
  {
    const smg::Report::Areas& areas = *report.areas;
    const char* const measure = areas.isVolume ? "volume" : "area";
    std::printf("%lld vertices, %s: %s %.9g\n", static_cast<long long>(report.vertices),
      smg::counted(areas.cells, "cell", "cells").c_str(), measure, areas.total);
    constexpr std::size_t Shown = 20;
    for (const smg::Report::Area& part : areas.by_tag | std::views::take(Shown))
    {
      std::printf("  tag %s: %s, %s %.9g\n", smg::shortest(part.tag).c_str(),
        smg::counted(part.cells, "cell", "cells").c_str(), measure, part.area);
    }
    if (areas.by_tag.size() > Shown)
    {
      std::printf("  and %zu more tags, which the report has\n", areas.by_tag.size() - Shown);
    }
  }

private:
  smg::AreaJob Job;
};

} // namespace

void addAreaCommand(CLI::App& program, Action& action)
{
  addJobCommand<AreaCommand>(program, action, "area");
}
