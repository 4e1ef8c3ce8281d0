// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"

#include "Filters/Poisson/vtkPoissonTask.h"
#include "Filters/Streaming/SolveSummary.h"
#include "Solver/Core/Error.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkStreamingPoisson);

namespace
{

/** The name of the input array that the information describes; empty if none is chosen. */
std::string arrayName(vtkInformation& info)
{
  const char* name =
    info.Has(vtkDataObject::FIELD_NAME()) ? info.Get(vtkDataObject::FIELD_NAME()) : nullptr;
  if (!name || !*name || std::string(name) == "None")
  {
    return {};
  }
  if (info.Has(vtkDataObject::FIELD_ASSOCIATION()) &&
      info.Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    throw smg::Error(
      std::string("The array ") + name +
      " is chosen from the cells: a point array is needed; use a filter that turns cell data "
      "into point data.");
  }
  return name;
}

} // namespace

vtkStreamingPoisson::vtkStreamingPoisson()
{
  this->SetResultArrayName("Solution");
}

vtkStreamingPoisson::~vtkStreamingPoisson()
{
  this->SetResultArrayName(nullptr);
}

int vtkStreamingPoisson::GetCycles()
{
  return this->GetSummary().cycles;
}

std::unique_ptr<smg::StreamedTask> vtkStreamingPoisson::MakeTask(vtkPointSet&)
{
  auto task = std::make_unique<smg::PoissonTask>();
  task->arrays = { .mask = arrayName(*this->GetInputArrayInformation(0)),
    .values = arrayName(*this->GetInputArrayInformation(1)),
    .source = arrayName(*this->GetInputArrayInformation(2)),
    .guess = arrayName(*this->GetInputArrayInformation(3)) };
  task->weights = this->ChosenWeights();
  task->screening = this->Screening;
  this->FillOptions(task->options);
  task->options.inCore = this->InCore;
  return task;
}

void vtkStreamingPoisson::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  vtkNew<vtkDoubleArray> solution;
  solution->SetName(this->ResultArrayName ? this->ResultArrayName : "Solution");
  solution->SetNumberOfComponents(this->GetSummary().columns);
  solution->SetNumberOfTuples(piece.GetNumberOfPoints());
  std::copy(values.begin(), values.end(), solution->GetPointer(0));
  output.GetPointData()->AddArray(solution);
}

void vtkStreamingPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Screening: " << this->Screening << "\n";
  os << indent << "InCore: " << this->InCore << "\n";
  os << indent << "ResultArrayName: " << (this->ResultArrayName ? this->ResultArrayName : "(none)")
     << "\n";
  os << indent << "Cycles: " << this->GetSummary().cycles << "\n";
}
