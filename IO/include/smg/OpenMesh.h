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
  /** Removes the converted file, if there is one. */
  ~OpenedMesh();

  /** The reader of the .vsm file, valid as long as this. */
  VsmReader& reader();
  /** What the conversion did, valid as long as this; null if the file is a .vsm file itself. */
  const ConversionReport* conversion() const;

private:
  friend std::unique_ptr<OpenedMesh> openMesh(
    const std::filesystem::path& path, const ConversionOptions& options);
  OpenedMesh();

  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * Opens a mesh file of any format that convert() reads. A .vsm file is read as it is; any other
 * file is converted to a .vsm file in the scratch folder, which lives as long as the OpenedMesh.
 * @param path the mesh file
 * @param options how to convert; a streaming format (SMA, SMB, SVA, SVB) keeps its order
 * @throws Error as convert()
 * @throws Cancelled as convert()
 */
SMG_EXPORT std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options = {});

} // namespace smg
