// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Streams/StreamFile.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace smg
{

// The parsers of the text formats (TextStreamReader.cpp) and of the binary ones
// (BinaryStreamReader.cpp), for detection and openStreamFile(). All throw Error.

/** Opens SMA or SVA. */
std::unique_ptr<StreamFileReader> openTextStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress);
/** The format of a text, by the first line that only one of them can have. */
std::optional<StreamFormat> formatOfText(InputFile& file);
/** Vertices and triangles alone are OBJ as well; other lines are of one format only. */
Resemblance resemblanceOfText(InputFile& file);

/** Opens SMB or SVB. */
std::unique_ptr<StreamFileReader> openBinaryStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress);
/** Reads the beginning of a SMB or SVB file. */
StreamFileHeader readBinaryHeader(InputFile& file, StreamFormat format);

/** First bytes of the binary formats. */
constexpr std::uint8_t SmbVersion = 0;
constexpr std::uint8_t SvbVersion = 4;

/** Elements of a full block of the binary formats. */
constexpr int BinaryBlockElements = 32;

} // namespace smg
