// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFileWriter.h"

#include "IO/Formats/Streams/BinaryStreamWriter.h"
#include "IO/Formats/Streams/TextStreamWriter.h"

#include <utility>

namespace smg
{

std::unique_ptr<StreamFileWriter> createStreamFile(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style)
{
  if (isText(header.format))
  {
    return std::make_unique<TextStreamWriter>(std::move(path), header, style);
  }
  return std::make_unique<BinaryStreamWriter>(std::move(path), header, style);
}

} // namespace smg
