// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/JobProperties.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingBlend);

vtkStreamingBlend::vtkStreamingBlend()
  : vtkStreamingSolver("blend")
{
}

vtkStreamingBlend::~vtkStreamingBlend() = default;

const std::vector<std::string>& vtkStreamingBlend::ChosenArrays() const
{
  return this->Arrays.empty() ? this->Columns : this->Arrays;
}

std::unique_ptr<smg::JobTask> vtkStreamingBlend::MakeTask(vtkPointSet& input)
{
  std::unique_ptr<smg::JobTask> task = this->Superclass::MakeTask(input);
  task->setColumns(this->ChosenArrays());
  return task;
}

void vtkStreamingBlend::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  std::size_t first = 0;
  for (const std::string& column : this->ChosenArrays())
  {
    first += smg::replaceArray(output, column, values, first, stride);
  }
}

void vtkStreamingBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Arrays:";
  for (const std::string& column : this->ChosenArrays())
  {
    os << ' ' << column;
  }
  os << "\n";
}
