// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

/** All formats. */
std::span<const Format* const> formats();

/** The format of a suffix, which is in lower case; null if there is none. */
SMG_EXPORT const Format* formatOfSuffix(std::string_view suffix);
/** The format of a file name's suffix; .gz at its end is left out of account. */
const Format* formatOfName(const std::filesystem::path& path);

/** The format by the signature of the file; null for formats without one, such as STL, OBJ and
 * TetGen. For a file compressed by gzip, the format of its content. */
const Format* formatOfContent(const std::filesystem::path& path);
/**
 * The format of an indexed mesh: by the sign that the file begins with, else by its first bytes if
 * they look like one, else by its suffix; null if nothing says it.
 */
SMG_EXPORT const Format* formatOfFile(const std::filesystem::path& path);
/** As formatOfFile(), of a file that begins with `start`. `size`: none if it is not known. */
const Format* formatOfStart(
  std::string_view start, std::optional<std::uint64_t> size, const std::filesystem::path& path);

/** The operations of formats. */
enum class FormatUse
{
  Read,
  Write,        ///< in stream order
  WriteColumns, ///< in stream order with all columns
  Restore       ///< in the order of the original file
};

/** The suffix of the path, if its files can be written so; null otherwise. */
SMG_EXPORT const FileSuffix* suffixFor(FormatUse use, const std::filesystem::path& path);

/** The suffixes of a format. */
SMG_EXPORT std::string suffixList(const Format& format, std::string_view conjunction);
/** The suffixes that can be used so, as ".ply, .obj or .off". */
SMG_EXPORT std::string suffixList(FormatUse use, std::string_view conjunction);
/** The suffixes that can be used so and hold such cells. */
SMG_EXPORT std::string suffixList(FormatUse use, CellType cells, std::string_view conjunction);

/** The error message for cells that a suffix cannot hold. */
std::string holdsNo(const FileSuffix& suffix, CellType cells, FormatUse use);

} // namespace smg
