// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/AnyFormat/MeshFile.h"
#include "IO/External/Workspace.h"
#include "IO/Formats/MeshPart.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace smg
{

/** What all ways to convert a mesh share: files, options, memory, and the report. */
class Conversion
{
public:
  /** Keeps references. Throws Error if the options do not hold for any mesh. */
  Conversion(const std::filesystem::path& in, const std::filesystem::path& out,
    const ConversionOptions& options);

  const std::filesystem::path& in() const { return this->In; }
  const std::filesystem::path& out() const { return this->Out; }
  const ConversionOptions& options() const { return this->Options; }
  /** What is wanted of the input. */
  MeshPart part() const { return { this->Options.timeStep, this->Options.partition }; }
  /** Limit of the memory, bytes. */
  std::int64_t memory() const { return this->Memory; }

  /** Scratch files and memory, made when they are first asked for. */
  Workspace& workspace();
  /** Progress of the workspace's current part, for what tells fractions. */
  ProgressFunction progress();

  MeshFileKind inputKind() const { return this->From; }
  /** Whether the input is in a stream order already. */
  bool isStream() const;
  /** Such an input, as a .vsm file. Throws Error if its cells are not those that are wanted. */
  const VsmReader& openStream();
  /** The stream that was opened, if any. */
  const VsmReader* stream() const { return this->Stream ? &*this->Stream : nullptr; }

  using AddTables = std::function<void(VsmWriter&)>;
  /** Writes the mesh in the format of the output; a .vsm file gets what `add` has to add. */
  void write(MeshSource& source, const AddTables& add);

  ConversionReport& report() { return this->Report; }
  /** Seconds since the last time it was asked. */
  double lap();

private:
  std::filesystem::path importStream();
  void checkCells(const StreamInfo& info) const;

  const std::filesystem::path& In;
  const std::filesystem::path& Out;
  const ConversionOptions& Options;
  const std::int64_t Memory;
  const MeshFileKind From, To;
  std::optional<Workspace> Space;
  std::optional<VsmReader> Stream;
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
  ConversionReport Report;
};

} // namespace smg
