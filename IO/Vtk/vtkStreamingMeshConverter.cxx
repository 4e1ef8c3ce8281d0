// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshConverter.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/KeptConversion.h"
#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Vtk/Failures.h"
#include "IO/Vtk/ModeProperty.h"
#include "IO/Vtk/PropertyRange.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkObjectFactory.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>

namespace
{

/** Whether a legacy VTK file contains an image or another structured grid. */
bool isStructured(const std::filesystem::path& name)
{
  std::string beginning(1024, '\0');
  std::ifstream(name).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return beginning.starts_with("# vtk DataFile") &&
         (beginning.find("DATASET STRUCTURED_") != std::string::npos ||
           beginning.find("DATASET RECTILINEAR_GRID") != std::string::npos);
}

/** The estimate for a mesh file that is not a stream; none if its format is unknown. */
std::optional<smg::ConversionEstimate> estimateOf(const char* name)
{
  try
  {
    if (!name || smg::kindOfInput(name) != smg::MeshFileKind::Indexed || isStructured(name))
    {
      return std::nullopt;
    }
    return smg::estimateConversion(name);
  }
  catch (const std::exception&)
  {
    return std::nullopt;
  }
}

/** Whether VTK has a reader for files with this suffix. */
bool isReadByVtk(const std::filesystem::path& name)
{
  const smg::Format* const format = smg::formatOfSuffix(smg::lowerSuffix(name));
  return format && format->isReadByVtk;
}

/** As "34,834" or "5.30 million". */
std::string rounded(std::int64_t count)
{
  constexpr std::int64_t Million = 1000000;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2)
       << static_cast<double>(count) / static_cast<double>(Million) << " million";
  return count < Million ? smg::groupedDigits(count) : text.str();
}

/** Bytes of the points and cells in VTK's own data sets. */
std::int64_t bytesInVtk(const smg::ConversionEstimate& estimate)
{
  constexpr double PointBytes = 3 * sizeof(float), IdBytes = sizeof(vtkIdType);
  // A surface has two triangles per vertex, a solid five to six tetrahedra.
  const double corners = estimate.cells > 3 * estimate.vertices ? 4.0 : 3.0;
  return static_cast<std::int64_t>(static_cast<double>(estimate.vertices) * PointBytes +
                                   static_cast<double>(estimate.cells) * (corners + 1.0) * IdBytes);
}

} // namespace

vtkStandardNewMacro(vtkStreamingMeshConverter);

vtkStreamingMeshConverter::vtkStreamingMeshConverter() = default;

vtkStreamingMeshConverter::~vtkStreamingMeshConverter() = default;

const char* vtkStreamingMeshConverter::GetReport()
{
  return this->Report.c_str();
}

int vtkStreamingMeshConverter::CanReadFile(const char* name)
{
  const auto estimate = estimateOf(name);
  if (!estimate)
  {
    return 0;
  }
  return !isReadByVtk(name) || estimate->vertices > this->GetMaximumPointsInMemory() ? 1 : 0;
}

std::string vtkStreamingMeshConverter::GetContainerName()
{
  const bool isMeshNamed = !this->Superclass::GetContainerName().empty();
  return isMeshNamed ? this->OutputFileName : "";
}

struct vtkStreamingMeshConverter::Internals
{
  /** Throws Error if a number is out of its range. */
  static smg::ConversionOptions optionsOf(vtkStreamingMeshConverter& self)
  {
    static constexpr smg::StreamOrder Orders[] = { smg::StreamOrder::BreadthFirst,
      smg::StreamOrder::Axis, smg::StreamOrder::Keep, smg::StreamOrder::Spectral };
    static constexpr smg::CellChoice Choices[] = { smg::CellChoice::Only,
      smg::CellChoice::Triangles, smg::CellChoice::Tetrahedra };
    smg::requireInRange(
      { { "Order", self.Order, BREADTH_FIRST, SPECTRAL }, { "Cells", self.Cells, ONLY, TETRAHEDRA },
        { "TimeStep", self.TimeStep, 0 }, { "Partition", self.Partition, -1 } });
    if (self.MemoryLimit != 0)
    {
      constexpr std::int64_t Least = smg::Workspace::MinMemory >> 20;
      smg::requireInRange({ { "MemoryLimit", self.MemoryLimit, Least, smg::PropertyRange::NoLimit,
        "0 (automatic)" } });
    }
    if (self.Weld)
    {
      smg::requireInRealRange({ { "WeldDistance", self.WeldDistance, 0.0 } });
    }
    const char* scratch = self.GetScratchDirectory();
    smg::ConversionOptions options;
    options.order = Orders[self.Order];
    options.cells = Choices[self.Cells];
    if (self.Weld)
    {
      options.weld = self.WeldDistance;
    }
    options.orient = self.Orient;
    options.timeStep = self.TimeStep;
    if (self.Partition >= 0)
    {
      options.partition = self.Partition;
    }
    options.memoryLimit = std::int64_t(self.MemoryLimit) << 20;
    options.scratch = scratch ? scratch : "";
    options.progress = smg::progressOf(self);
    return options;
  }

  /** Takes the counts of the container if that is the conversion. */
  static void countMade(vtkStreamingMeshConverter& self, smg::ConversionEstimate& estimate)
  {
    try
    {
      if (self.IsContainerMade())
      {
        const smg::VsmReader made(self.GetContainerName());
        estimate.vertices = made.info().vertices;
        estimate.cells = made.info().cells;
        estimate.counted = true;
      }
    }
    catch (const std::exception&)
    {
      // Properties out of their range, which Apply reports, or a file that has just been replaced.
    }
  }
};

const char* vtkStreamingMeshConverter::GetEstimate()
{
  this->Estimate = "Known once a mesh file is named that is sorted, not a stream or a .vsm file.";
  if (auto estimate = estimateOf(this->GetFileName()))
  {
    Internals::countMade(*this, *estimate);
    std::ostringstream text;
    text << "About " << rounded(estimate->vertices) << " points and " << rounded(estimate->cells)
         << " cells" << (estimate->counted ? "" : ", as guessed from the size of the file")
         << ": a reader that reads all of it takes at least "
         << smg::mebibytes(bytesInVtk(*estimate)) << ", the conversion "
         << smg::mebibytes(estimate->memory_bytes);
    this->Estimate = text.str();
  }
  return this->Estimate.c_str();
}

bool vtkStreamingMeshConverter::IsContainerMade()
{
  return smg::isKept(this->GetFileName(), this->GetContainerName(), Internals::optionsOf(*this));
}

void vtkStreamingMeshConverter::ChooseConversion(smg::ConversionOptions& options)
{
  options = Internals::optionsOf(*this);
}

void vtkStreamingMeshConverter::UpdateContainer()
{
  const std::string out = this->GetContainerName();
  if (out.empty())
  {
    throw smg::Error("No conversion is named: set FileName and OutputFileName.");
  }
  const std::string unused = smg::unusedProperty(
    { { "WeldDistance", this->WeldDistance != 0.0, this->Weld, "turn Weld on" } });
  if (!unused.empty() && unused != this->Warned)
  {
    vtkWarningMacro(<< unused);
  }
  this->Warned = unused;
  // Of a conversion that fails there is no report, and that of the last one is not about it.
  const std::string last = this->ReportedName == out ? this->Report : "";
  this->Report.clear();
  const auto report =
    smg::convertToKeep(this->GetFileName(), out, Internals::optionsOf(*this), this->Overwrite);
  this->Report = report ? report->json() : last;
  this->ReportedName = out;
}

void vtkStreamingMeshConverter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputFileName: " << smg::textOrNone(this->OutputFileName) << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Cells: " << this->Cells << "\n";
  os << indent << "Weld: " << this->Weld << "\n";
  os << indent << "WeldDistance: " << this->WeldDistance << "\n";
  os << indent << "Orient: " << this->Orient << "\n";
  os << indent << "TimeStep: " << this->TimeStep << "\n";
  os << indent << "Partition: " << this->Partition << "\n";
  os << indent << "Overwrite: " << this->Overwrite << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Report: " << this->Report << "\n";
}
