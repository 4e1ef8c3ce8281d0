// SPDX-License-Identifier: BSD-3-Clause
#include "InputOptions.h"

#include "CommonOptions.h"

#include "IO/AnyFormat/MeshFile.h"
#include "smg/Error.h"

void InputOptions::addTo(CLI::App& command)
{
  command
    .add_option(
      "--cells", this->Cells, "Cells to keep of a mesh with both types: triangles or tets")
    ->check(oneOf({ "triangles", "tets" }));
  command
    .add_option(
      "--weld", this->Weld, "Merge points within this distance of each other; 0: equal coordinates")
    ->check(CLI::NonNegativeNumber)
    ->type_name("DISTANCE");
  command
    .add_option("--time-step", this->TimeStep, "Which time step to read of a VTKHDF file, from 0")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str()
    ->type_name("N");
  command
    .add_option("--partition", this->Partition,
      "Which partition to read of a VTKHDF file, from 0; all, joined, unless given")
    ->check(CLI::NonNegativeNumber)
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

void InputOptions::checkIsConverted(const std::filesystem::path& in) const
{
  const bool asksForSome =
    this->Weld || !this->Cells.empty() || this->TimeStep != 0 || this->Partition;
  if (asksForSome && smg::kindOfInput(in) == smg::MeshFileKind::Vsm)
  {
    throw smg::Error(in.string() + ": a .vsm file is used as it is: leave --cells, --weld, "
                                   "--time-step and --partition out, or give them to smg convert.");
  }
}
