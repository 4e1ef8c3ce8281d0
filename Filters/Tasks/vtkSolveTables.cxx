// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkSolveTables.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>

namespace smg
{
namespace
{

constexpr double MiB = 1 << 20;

template <class Value>
void addColumn(vtkTable& table, const char* name, const SolveSummary& summary, Value value)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  double number = 0.0;
  for (const Report::Pass& pass : summary.byPass)
  {
    number += 1.0;
    column->InsertNextValue(value(pass, number));
  }
  table.AddColumn(column);
}

} // namespace

void fillPasses(const SolveSummary& summary, std::int64_t memoryLimit, vtkTable& table)
{
  using Pass = Report::Pass;
  table.Initialize();
  addColumn(table, "Pass", summary, [](const Pass&, double number) { return number; });
  addColumn(table, "Residual", summary, [](const Pass& pass, double) { return pass.residual; });
  addColumn(table, "Seconds", summary, [](const Pass& pass, double) { return pass.seconds; });
  addColumn(table, "Read (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.read) / MiB; });
  addColumn(table, "Written (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.written) / MiB; });
  addColumn(table, "Memory (MiB)", summary,
    [](const Pass& pass, double) { return static_cast<double>(pass.pool_bytes) / MiB; });
  addColumn(table, "Memory Limit (MiB)", summary,
    [memoryLimit](const Pass&, double) { return static_cast<double>(memoryLimit) / MiB; });
}

void fillText(const SolveSummary& summary, vtkTable& table)
{
  table.Initialize();
  vtkNew<vtkStringArray> text;
  text->SetName("Text");
  std::string sentence = summary.where();
  if (const std::size_t comma = sentence.find(", the result"); comma != std::string::npos)
  {
    sentence[comma + 1] = '\n'; // for narrow views
  }
  text->InsertNextValue(sentence);
  table.AddColumn(text);
}

} // namespace smg
