// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/Conversion/CompressedStream.h"
#include "IO/Conversion/Conversion.h"
#include "IO/Conversion/ConvertMesh.h"
#include "IO/Conversion/CopyStream.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/WriteRestored.h"
#include "Solver/Core/Timer.h"
#include "smg/Error.h"

#include <limits>

namespace smg
{

namespace
{

/** Restores the order of the original file. */
void restoreMesh(Conversion& conversion)
{
  if (conversion.inputKind() != MeshFileKind::Vsm)
  {
    throw Error(conversion.in().string() +
                ": only a .vsm file knows the order of the file that it was made of: give one.");
  }
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
  const VsmReader reader(conversion.in());
  const StreamInfo& info = reader.info();
  report.order = "restored";
  report.vertices = info.vertices;
  report.cells = info.cells;
  report.notes = writeRestored(conversion.in(), conversion.out(), space);
  report.seconds.write = conversion.lap();
}

void run(Conversion& conversion)
{
  const ConversionOptions& options = conversion.options();
  if (options.restoreOrder)
  {
    restoreMesh(conversion);
    return;
  }
  checkOutput(conversion.out());
  conversion.report().order = nameOf(options.order);
  conversion.copies() ? copyStream(conversion) : convertMesh(conversion);
}

} // namespace

ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
{
  checkIsNotInput(in, out);
  checkOutputPlace(out);
  if (!options.checkpoint.empty() && !Conversion::hasStages(in, options))
  {
    throw Error(in.string() +
                ": this conversion has no stages from which it could continue: leave the "
                "checkpoint out (option --checkpoint).");
  }
  if (isCompressedStream(in))
  {
    return convertCompressedStream(in, out, options);
  }
  const Timer timer;
  const double cpu = processSeconds();
  Conversion conversion(in, out, options);
  run(conversion);
  Workspace& space = conversion.workspace();
  ConversionReport report = conversion.report();
  report.pool_bytes_peak = space.pool().peak();
  report.scratch_bytes_peak = space.peakScratch();
  report.scratch_bytes_read = space.traffic().bytesRead;
  report.scratch_bytes_written = space.traffic().bytesWritten;
  report.seconds.total = timer.seconds();
  report.cpu_seconds = processSeconds() - cpu;
  report.rss_bytes_peak = peakResidentBytes();
  return report;
}

} // namespace smg
