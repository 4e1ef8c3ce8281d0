// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Regions/RegionArrays.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/BlendJob.h"
#include "IO/Jobs/JobProperties.h"
#include "smg/Error.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingBlend);

namespace
{

class BlendTask : public smg::JobTask
{
public:
  smg::BlendJob asked;

  BlendTask()
    : JobTask("this is the blended preview", "blended")
  {
  }

  void check() const override
  {
    this->JobTask::check();
    if (this->asked.description.patch.empty())
    {
      throw smg::Error("Patch must name the array with the patch of each point or cell.");
    }
    if (this->asked.description.columns.empty())
    {
      throw smg::Error("Arrays must name at least one point array to blend.");
    }
  }

protected:
  smg::BlendJob& job() override { return this->asked; }
  std::vector<smg::Where>& places() override { return this->asked.description.hold; }
};

} // namespace

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
  auto task = std::make_unique<BlendTask>();
  this->FillOptions(task->asked.solving);
  task->setLimits(task->asked.solving);
  this->Options->applyTo(task->asked);
  task->asked.description.columns = this->ChosenArrays();
  task->asked.description.hold = smg::placesOn(input, this->GetHold(), "Hold");
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
