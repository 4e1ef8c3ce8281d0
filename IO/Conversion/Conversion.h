// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/UsedFiles.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Mesh/Format.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace smg
{

/** Brings a mesh that is in no file into scratch files. Reports its progress, from 0 to 1. */
using MeshImporter = std::function<RawMesh(Workspace&, const ProgressFunction&)>;

/** The common state of all conversions: files, options, memory, and the report. */
class Conversion
{
public:
  /** Keeps references. With an importer, the mesh is in no file, and `in` is what errors call it.
   * Throws Error if the options are invalid for any mesh. */
  Conversion(const std::filesystem::path& in, const std::filesystem::path& out,
    const ConversionOptions& options, MeshImporter importer = {});

  /** Whether such a conversion has stages, from which it can continue with a checkpoint. */
  static bool hasStages(const std::filesystem::path& in, const ConversionOptions& options);

  const std::filesystem::path& in() const { return this->In; }
  const std::filesystem::path& out() const { return this->Out; }
  const ConversionOptions& options() const { return this->Options; }
  /** Which part of the input is read. */
  MeshPart part() const { return { this->Options.timeStep, this->Options.partition }; }
  /** The memory limit in bytes. */
  std::int64_t memory() const { return this->Memory; }

  /** Scratch files and memory, created on first use. */
  Workspace& workspace();
  /** The parent of the folder for scratch files. */
  const std::filesystem::path& scratch() const
  {
    return this->Options.checkpoint.empty() ? this->Options.scratch : this->Options.checkpoint;
  }
  /** The folder ConversionOptions::checkpoint; nullptr: none. */
  ScratchFolder* kept();
  /** The progress of the current part of the workspace, for operations that report fractions. */
  ProgressFunction progress();

  MeshFileKind inputKind() const { return this->From; }
  /** Of a mesh that is in no file; else empty. */
  const MeshImporter& importer() const { return this->Importer; }
  /** Whether the input already has a stream order. */
  bool isStream() const
  {
    return this->From == MeshFileKind::Vsm || this->From == MeshFileKind::Stream;
  }
  /** Whether the cells are only copied. */
  bool copies() const
  {
    return this->isStream() && this->Options.order == StreamOrder::Keep && !this->Options.weld;
  }
  /** Throws Error if the input has been replaced or changed since the conversion began. A .vsm file
   * is compared by its reader. */
  void checkInput() const { this->State.check(); }
  /** Opens such an input as a .vsm file. Throws Error if it does not have the requested cells. */
  const VsmReader& openStream();
  /** The opened stream, if any. */
  const VsmReader* stream() const { return this->Stream ? &*this->Stream : nullptr; }

  using AddTables = std::function<void(VsmWriter&)>;
  /** Writes the mesh in the format of the output; `add` adds tables to a .vsm file. */
  void write(MeshSource& source, const AddTables& add);

  ConversionReport& report() { return this->Report; }
  /** Seconds since the last call. */
  double lap();

private:
  void checkOptions() const;
  std::filesystem::path importStream();
  void checkCells(const StreamInfo& info) const;
  void checkRows(const StreamInfo& mesh) const;

  const std::filesystem::path& In;
  const std::filesystem::path& Out;
  const ConversionOptions& Options;
  const std::int64_t Memory;
  MeshImporter Importer;
  MeshFileKind From, To;
  InputState State;
  std::optional<ScratchFolder> Kept;
  std::optional<Workspace> Space; // in the kept folder, if there is one
  std::optional<VsmReader> Stream;
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
  ConversionReport Report;
};

/** Runs the stages of convert() and completes the report. */
ConversionReport runConversion(Conversion& conversion);

/** Whether the file is a stream compressed by gzip, according to its first bytes and its name. */
bool isCompressedStream(const std::filesystem::path& path);

} // namespace smg
