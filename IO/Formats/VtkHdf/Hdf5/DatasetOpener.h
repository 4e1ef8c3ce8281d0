// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkArray.h"

#include <memory>
#include <string>

namespace smg
{

class Hdf5File;

/** Opens a dataset for the readers of arrays of VTK's files. The file must outlive this object. */
class DatasetOpener : public VtkArrayOpener
{
public:
  DatasetOpener(const Hdf5File& file, std::string name);

  std::unique_ptr<ByteSource> open(
    InputFile& file, const VtkArray& array, Pool& pool) const override;

private:
  const Hdf5File& Hdf;
  std::string Name;
};

} // namespace smg
