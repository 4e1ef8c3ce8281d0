// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"

#include <array>
#include <cstddef>
#include <optional>

namespace smg
{

/** The files of a mesh, whose arrays are read concurrently, each through its own window. Only the
 * files of one piece are open. */
class VtkFiles
{
public:
  enum Window
  {
    Main,
    Offsets,
    Types,
    Ghosts,
    Windows
  };

  /** `first` is the only file of the layout, or the one that names the files. */
  VtkFiles(InputFile& first, const VtkLayout& layout, ProgressFunction progress = {})
    : First(first)
    , Layout(layout)
    , Report(std::move(progress))
  {
  }

  /** A file, through a window. Closes the previous file of the same window. */
  InputFile& open(std::size_t file, Window window);

  /** For several files: reports that this share of the whole is done. Throws Cancelled. */
  void progress(double done);

private:
  struct Opened
  {
    std::size_t file = 0;
    std::optional<InputFile> window;
  };

  InputFile& First;
  const VtkLayout& Layout;
  ProgressFunction Report;
  double Done = 0.0;
  std::array<Opened, Windows> Opens;
};

} // namespace smg
