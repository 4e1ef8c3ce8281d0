// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Convert.h"
#include "IO/Formats/Vsm/VsmReader.h"
#include "Solver/Storage/ScratchFolder.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace smg
{

/** A mesh file of any kind, open as a .vsm file. */
class OpenedMesh
{
public:
  VsmReader& reader() { return *this->Reader; }
  /** What the conversion did; none if the file was a .vsm file. */
  const std::optional<ConversionReport>& conversion() const { return this->Conversion; }

private:
  friend std::unique_ptr<OpenedMesh> openMesh(
    const std::filesystem::path& path, const ConversionOptions& options);

  std::optional<ScratchFolder> Scratch;
  std::optional<ConversionReport> Conversion;
  std::unique_ptr<VsmReader> Reader;
};

/**
 * Opens a mesh file of any kind that convert() reads. A .vsm file is read as it is. Everything else
 * is converted to a .vsm file in the scratch folder, which is removed with the OpenedMesh:
 * streaming formats in the order they have, all others in the order of the options.
 * @throws Error, Cancelled as convert()
 */
std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options = {});

} // namespace smg
