// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"
#include "smg/Export.h"
#include "smg/VsmReader.h"

#include <filesystem>
#include <memory>

namespace smg
{

/** A mesh file of any format, open as a .vsm file. */
class SMG_EXPORT OpenedMesh
{
public:
  ~OpenedMesh();

  VsmReader& reader();
  /** The report of the conversion; null if the file is a .vsm file. */
  const ConversionReport* conversion() const;

private:
  friend std::unique_ptr<OpenedMesh> openMesh(
    const std::filesystem::path& path, const ConversionOptions& options);
  OpenedMesh();

  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * Opens a mesh file of any format that convert() reads. A .vsm file is read directly; all others
 * are converted to a .vsm file in the scratch folder, which is removed with the OpenedMesh:
 * streaming formats in their order, all others in the order of the options.
 * @throws Error, Cancelled like convert()
 */
SMG_EXPORT std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options = {});

} // namespace smg
