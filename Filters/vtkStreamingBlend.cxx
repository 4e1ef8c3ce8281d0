// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"

#include "Filters/Pieces/vtkReplacedArray.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkBlendTask.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingBlend);

struct vtkStreamingBlend::Internals
{
  explicit Internals(vtkStreamingBlend& self)
    : Self(self)
  {
  }

  std::unique_ptr<smg::BlendTask> task(vtkPointSet& input) const
  {
    auto task = std::make_unique<smg::BlendTask>();
    this->Self.FillOptions(task->options);
    // "None" is what ParaView offers for no array.
    const std::string patch = this->Self.Patch ? this->Self.Patch : "";
    task->description.patch = patch == "None" ? "" : patch;
    task->description.columns = this->chosen();
    task->description.anchor = this->Self.Anchor;
    task->description.seam =
      this->Self.SeamGradient == AVERAGE ? smg::SeamGradient::Average : smg::SeamGradient::Zero;
    task->description.hold = smg::regionsOf(input);
    if (this->Self.Hold && *this->Self.Hold)
    {
      std::ranges::move(
        smg::readPlacesText(this->Self.Hold, "Hold"), std::back_inserter(task->description.hold));
    }
    return task;
  }

  const std::vector<std::string>& chosen() const
  {
    return this->Arrays.empty() ? this->Columns : this->Arrays;
  }

  vtkStreamingBlend& Self;
  std::vector<std::string> Arrays, Columns;
};

vtkStreamingBlend::vtkStreamingBlend()
  : Internal(new Internals(*this))
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

std::unique_ptr<smg::StreamedTask> vtkStreamingBlend::MakeTask(vtkPointSet& input)
{
  return this->Internal->task(input);
}

smg::SolveSummary vtkStreamingBlend::SolveInMemory(
  vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  if (input.GetNumberOfCells() == 0)
  {
    return this->SummaryOfNothing(0); // of a preview that is in another process
  }
  return this->Internal->task(input)->solveOnPreview(input, progress, values);
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
