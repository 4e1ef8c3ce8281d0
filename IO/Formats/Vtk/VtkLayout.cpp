// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkLayout.h"

#include <algorithm>

namespace smg
{

InputFile& VtkFiles::open(std::size_t file, Window window)
{
  const VtkFile& wanted = this->Layout.files[file];
  if (wanted.path == this->First.path() && window == Main)
  {
    return this->First;
  }
  Opened& opened = this->Opens[window];
  if (!opened.window || opened.file != file)
  {
    // Long reads still poll for cancellation.
    const auto same = [this](double) { return !this->Report || this->Report(this->Done); };
    opened.window.reset();
    opened.window.emplace(wanted.path, same, wanted.name);
    opened.file = file;
  }
  return *opened.window;
}

void VtkFiles::progress(double done)
{
  this->Done = std::max(this->Done, std::min(done, 1.0));
  if (this->Report && !this->Report(this->Done))
  {
    throw Cancelled();
  }
}

} // namespace smg
