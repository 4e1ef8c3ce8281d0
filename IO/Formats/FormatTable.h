// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"
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
SMG_EXPORT std::span<const Format* const> formats();

/** The format of a lower-case suffix; null if there is none. */
SMG_EXPORT const Format* formatOfSuffix(std::string_view suffix);
/** The format of the suffix of a file name, ignoring a trailing .gz, .xz or .zst. */
const Format* formatOfName(const std::filesystem::path& path);

/** The format by the signature of the file; null for formats without one, such as STL, OBJ and
 * TetGen. For a file compressed, the format of its content. */
const Format* formatOfContent(const std::filesystem::path& path);
/** The format without a signature that the first bytes look like; null if there is none. */
const Format* formatByContent(const std::filesystem::path& path);
/** The format of an indexed mesh: by the signature of the file, else by the form of its first
 * bytes, else by its suffix; null if unknown. */
SMG_EXPORT const Format* formatOfFile(const std::filesystem::path& path);
/** Like formatOfFile(), for a file that begins with `start`. `size`: none if unknown. */
const Format* formatOfStart(
  std::string_view start, std::optional<std::uint64_t> size, const std::filesystem::path& path);

/** Whether a file that begins with `start` has the signature or the form of a format. */
bool isKnownByContent(std::string_view start, std::optional<std::uint64_t> size);

/** The operations of formats. */
enum class FormatUse
{
  Read,
  Write,         ///< in stream order
  WriteColumns,  ///< in stream order with all columns
  WriteEither,   ///< binary, or as text on request
  Restore,       ///< in the order of the original file
  RestoreColumns ///< the same with all columns
};

/** The suffix of the path, if it supports the operation; null otherwise. */
SMG_EXPORT const FileSuffix* suffixFor(FormatUse use, const std::filesystem::path& path);

/** Whether a file of this name, of an indexed mesh, has places for these columns of the vertices.
 */
SMG_EXPORT bool restoresColumns(
  const std::filesystem::path& path, std::span<const std::string> columns);

/** The suffixes of a format. */
SMG_EXPORT std::string suffixList(const Format& format, std::string_view conjunction);
/** The suffixes that support the operation, for example ".ply, .obj or .off". */
SMG_EXPORT std::string suffixList(FormatUse use, std::string_view conjunction);
/** The suffixes that support the operation for these cells. */
SMG_EXPORT std::string suffixList(FormatUse use, CellType cells, std::string_view conjunction);

/** The suffixes that support one of the operations; `cells`: only those for these cells. */
SMG_EXPORT std::string suffixList(
  std::span<const FormatUse> uses, std::optional<CellType> cells, std::string_view conjunction);

/** Throws Error unless the suffix of the file holds these cells. `choices`: the suffixes to choose
 * from. */
SMG_EXPORT void checkHolds(const std::filesystem::path& path, const FileSuffix& suffix,
  CellType cells, const std::string& choices);

/** Throws Error if `text` is requested, but files of this name are binary. A suffix that is not
 * written at all is no matter of this. */
SMG_EXPORT void checkForm(const std::filesystem::path& path, bool text);

} // namespace smg
