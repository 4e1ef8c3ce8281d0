// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Regions/RegionArrays.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/BlendJob.h"
#include "IO/Vtk/PropertyRange.h"
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

struct vtkStreamingBlend::Internals
{
  const std::vector<std::string>& chosen() const
  {
    return this->Arrays.empty() ? this->Columns : this->Arrays;
  }

  std::vector<std::string> Arrays, Columns;
};

vtkStreamingBlend::vtkStreamingBlend()
  : Internal(new Internals)
{
}

vtkStreamingBlend::~vtkStreamingBlend()
{
  this->SetPatch(nullptr);
  this->SetHold(nullptr);
}

void vtkStreamingBlend::AddArray(const char* name)
{
  if (name && *name)
  {
    this->Internal->Arrays.emplace_back(name);
    this->Modified();
  }
}

void vtkStreamingBlend::RemoveAllArrays()
{
  if (!this->Internal->Arrays.empty())
  {
    this->Internal->Arrays.clear();
    this->Modified();
  }
}

int vtkStreamingBlend::GetNumberOfArrays() const
{
  return static_cast<int>(this->Internal->Arrays.size());
}

const char* vtkStreamingBlend::GetArray(int number) const
{
  return number >= 0 && number < this->GetNumberOfArrays()
           ? this->Internal->Arrays[static_cast<std::size_t>(number)].c_str()
           : nullptr;
}

void vtkStreamingBlend::AddColumn(const char* name)
{
  if (name && *name)
  {
    this->Internal->Columns.emplace_back(name);
    this->Modified();
  }
}

void vtkStreamingBlend::RemoveAllColumns()
{
  if (!this->Internal->Columns.empty())
  {
    this->Internal->Columns.clear();
    this->Modified();
  }
}

int vtkStreamingBlend::GetNumberOfColumns() const
{
  return static_cast<int>(this->Internal->Columns.size());
}

const char* vtkStreamingBlend::GetColumn(int number) const
{
  return number >= 0 && number < this->GetNumberOfColumns()
           ? this->Internal->Columns[static_cast<std::size_t>(number)].c_str()
           : nullptr;
}

void vtkStreamingBlend::CheckRanges() const
{
  this->Superclass::CheckRanges();
  smg::requireInRange({ { "SeamGradient", this->SeamGradient, ZERO, AVERAGE } });
  smg::requireInRealRange({ { "Anchor", this->Anchor, 0.0 } });
}

std::unique_ptr<smg::JobTask> vtkStreamingBlend::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<BlendTask>();
  this->FillOptions(task->asked.solving);
  task->setLimits(task->asked.solving);
  smg::BlendDescription& description = task->asked.description;
  // "None" is what ParaView offers for no array.
  const std::string patch = this->Patch ? this->Patch : "";
  description.patch = patch == "None" ? "" : patch;
  description.columns = this->Internal->chosen();
  description.anchor = this->Anchor;
  description.seam =
    this->SeamGradient == AVERAGE ? smg::SeamGradient::Average : smg::SeamGradient::Zero;
  description.hold = smg::placesOn(input, this->Hold, "Hold");
  return task;
}

void vtkStreamingBlend::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  std::size_t first = 0;
  for (const std::string& column : this->Internal->chosen())
  {
    first += smg::replaceArray(output, column, values, first, stride);
  }
}

void vtkStreamingBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Patch: " << (this->Patch ? this->Patch : "(none)") << "\n";
  os << indent << "Arrays:";
  for (const std::string& column : this->Internal->chosen())
  {
    os << ' ' << column;
  }
  os << "\n" << indent << "Hold: " << (this->Hold ? this->Hold : "(none)") << "\n";
  os << indent << "Anchor: " << this->Anchor << "\n";
  os << indent << "SeamGradient: " << (this->SeamGradient == AVERAGE ? "average" : "zero") << "\n";
}
