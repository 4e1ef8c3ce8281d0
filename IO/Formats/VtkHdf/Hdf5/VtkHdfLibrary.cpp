// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/VtkHdfLibrary.h"

#include "IO/Formats/VtkHdf/Hdf5/ImportVtkHdf.h"
#include "IO/Formats/VtkHdf/Hdf5/WriteVtkHdf.h"

#include <hdf5.h>

extern "C" const smg::VtkHdfLibrary* smgVtkHdfLibrary()
{
  // At the end of a program, the library may crash on files that it could not close.
  H5dont_atexit();
  static constexpr smg::VtkHdfLibrary library{ smg::importVtkHdf, smg::countsOfVtkHdf,
    [](const std::filesystem::path& vsm, const std::filesystem::path& path,
      const smg::ProgressFunction& progress) { return smg::writeVtkHdf(vsm, path, progress); } };
  return &library;
}
