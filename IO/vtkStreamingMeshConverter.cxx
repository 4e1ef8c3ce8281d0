// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkStreamingMeshConverter.h"

#include "IO/Conversion/KeptConversion.h"
#include "IO/vtkAlgorithmGlue.h"
#include "IO/vtkMeshImport.h"
#include "Solver/Core/Error.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkStreamingMeshConverter);

vtkStreamingMeshConverter::vtkStreamingMeshConverter() = default;

vtkStreamingMeshConverter::~vtkStreamingMeshConverter()
{
  this->SetOutputFileName(nullptr);
}

const char* vtkStreamingMeshConverter::GetReport()
{
  return this->Report.c_str();
}

std::string vtkStreamingMeshConverter::GetContainerName()
{
  const bool isMeshNamed = !this->Superclass::GetContainerName().empty();
  return isMeshNamed && this->OutputFileName ? this->OutputFileName : "";
}

void vtkStreamingMeshConverter::UpdateContainer()
{
  static constexpr smg::StreamOrder Orders[] = { smg::StreamOrder::BreadthFirst,
    smg::StreamOrder::Axis, smg::StreamOrder::Keep, smg::StreamOrder::Spectral };
  static constexpr smg::CellChoice Choices[] = { smg::CellChoice::Only, smg::CellChoice::Triangles,
    smg::CellChoice::Tetrahedra };
  const std::string out = this->GetContainerName();
  if (out.empty())
  {
    throw smg::Error("No conversion is named: set FileName and OutputFileName.");
  }
  const char* scratch = this->GetScratchDirectory();
  smg::ConversionOptions options;
  options.order = Orders[this->Order];
  options.cells = Choices[this->Cells];
  if (this->Weld)
  {
    options.weld = this->WeldDistance;
  }
  options.memoryLimit = std::int64_t(this->MemoryLimit) << 20;
  options.scratch = scratch ? scratch : "";
  options.progress = smg::progressOf(*this);
  smg::registerVtkImporter();
  const auto report = smg::convertToKeep(this->GetFileName(), out, options, this->Overwrite);
  if (report || this->ReportedName != out)
  {
    this->Report = report ? report->json() : std::string();
    this->ReportedName = out;
  }
}

void vtkStreamingMeshConverter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputFileName: " << (this->OutputFileName ? this->OutputFileName : "(none)")
     << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Cells: " << this->Cells << "\n";
  os << indent << "Weld: " << this->Weld << "\n";
  os << indent << "WeldDistance: " << this->WeldDistance << "\n";
  os << indent << "Overwrite: " << this->Overwrite << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Report: " << this->Report << "\n";
}
