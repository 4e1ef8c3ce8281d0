// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CompressedStream.h"

#include "IO/External/Workspace.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "smg/Error.h"

#include <string>

namespace smg
{

bool isCompressedStream(const std::filesystem::path& path)
{
  // A text stream looks like an OBJ file: its name decides.
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) &&
         std::filesystem::file_size(path, ignored) > 0 && isGzip(InputFile(path).at(0, 2)) &&
         (kindOfInput(path) != MeshFileKind::Indexed || streamFormatOfName(path.stem()));
}

ConversionReport convertCompressedStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options)
{
  Workspace space(options.scratch, Workspace::MinMemory, {}, options.scratchLimit);
  ConversionOptions inner = options;
  inner.scratch = space.folder();
  inner.checkpoint.clear(); // the inflated file has another name in each program
  InputFile file(in);
  const std::string name = in.stem().string() + ".stream";
  const InflatedFile inflated(file, space, name.c_str());
  try
  {
    ConversionReport report = convert(inflated.path(), out, inner);
    report.scratch_bytes_peak = space.peakScratch();
    return report;
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const Error& error)
  {
    std::string sentence = error.what();
    const std::string path = inflated.path().string();
    if (sentence.starts_with(path))
    {
      sentence.replace(0, path.size(), in.string());
    }
    throw Error(sentence);
  }
}

} // namespace smg
