// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Core/Text.h"
#include "Testing/Fuzzing/Finding.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace smg::testing
{

/** The folder and the workspace of all runs, since creating them takes longer than most runs. */
class FuzzPlace
{
public:
  static FuzzPlace& instance()
  {
    static FuzzPlace place;
    return place;
  }

  Workspace& workspace() { return this->Space; }

  /** The path of a file. */
  std::filesystem::path path(const std::string& name) const { return this->Folder / name; }

  /** Writes a file, replacing that of an earlier run; its name may begin with a folder. */
  std::filesystem::path write(const std::string& name, std::string_view bytes)
  {
    const std::filesystem::path path = this->path(name);
    std::filesystem::create_directory(path.parent_path());
    // Some file systems wait for the disk when a file is truncated and written again.
    std::filesystem::remove(path);
    writeBytes(path, bytes);
    return path;
  }

  /** Runs a reader. Returns whether it succeeded; false if it threw an Error. Throws Finding if the
   * Error does not name the file, in one line, or if anything is left in the workspace. */
  bool run(const auto& read)
  {
    bool accepted = true;
    try
    {
      read();
    }
    catch (const Error& error)
    {
      accepted = false;
      this->checkMessage(error.what());
    }
    this->checkWorkspace();
    return accepted;
  }

private:
  FuzzPlace()
    : Space(Folder.path(), Workspace::MinMemory)
    , OwnEntries(this->workspaceEntries())
  {
  }

  std::ptrdiff_t workspaceEntries() const
  {
    return std::distance(std::filesystem::directory_iterator(this->Space.folder()), {});
  }

  void checkMessage(std::string_view message) const
  {
    // The position may be in another file of the folder: in a piece, or in the nodes of the
    // elements.
    if (message.find(this->Folder.path().string()) == std::string_view::npos)
    {
      throw Finding("the Error does not name the file: " + std::string(message));
    }
    if (oneLine(std::string(message)) != message)
    {
      throw Finding("the Error has a control character: " + std::string(message));
    }
  }

  void checkWorkspace()
  {
    if (this->Space.pool().used() != 0)
    {
      throw Finding(std::to_string(this->Space.pool().used()) + " bytes of the pool are left");
    }
    if (this->Space.pool().peak() > Workspace::MinMemory)
    {
      throw Finding("more memory was taken from the pool than allowed");
    }
    if (this->workspaceEntries() != this->OwnEntries)
    {
      throw Finding("files are left in the workspace");
    }
  }

  TemporaryFolder Folder;
  Workspace Space;
  std::ptrdiff_t OwnEntries; ///< that the workspace itself has
};

} // namespace smg::testing
