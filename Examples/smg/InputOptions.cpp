// SPDX-License-Identifier: BSD-3-Clause
#include "InputOptions.h"

#include "CommonOptions.h"

#include <cmath>

namespace
{

/** Checks that the value of an option is a distance: finite and not negative. */
std::string distance(const std::string& value)
{
  const std::optional<double> number = numberOf(value);
  return number && std::isfinite(*number) && *number >= 0.0
           ? std::string()
           : '\'' + value + "' is not a finite distance from 0 on";
}

} // namespace

void InputOptions::addTo(CLI::App& command)
{
  command
    .add_option(
      "--cells", this->Cells, "Cells to keep of a mesh with both types: triangles or tets")
    ->check(oneOf({ "triangles", "tets" }));
  command
    .add_option(
      "--weld", this->Weld, "Merge points within this distance of each other; 0: equal coordinates")
    ->check(distance)
    ->type_name("DISTANCE");
  command
    .add_option("--time-step", this->TimeStep, "Which time step to read of a VTKHDF file, from 0")
    ->check(wholeNumber)
    ->capture_default_str()
    ->type_name("N");
  command
    .add_option("--partition", this->Partition,
      "Which partition to read of a VTKHDF file, from 0; all, joined, unless given")
    ->check(wholeNumber)
    ->type_name("K");
}

void InputOptions::applyTo(smg::ConversionOptions& options) const
{
  options.cells = this->Cells.empty()          ? smg::CellChoice::Only
                  : this->Cells == "triangles" ? smg::CellChoice::Triangles
                                               : smg::CellChoice::Tetrahedra;
  options.weld = this->Weld;
  options.timeStep = this->TimeStep;
  options.partition = this->Partition;
}
