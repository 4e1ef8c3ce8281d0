// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/Importer.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace smg
{

/** As many bytes of a file as tell its format. */
inline constexpr std::size_t FormatBytes = 4096;

/** The format whose sign the first bytes have; Unknown for formats without one. */
MeshFormat formatOfSign(std::string_view bytes);

/**
 * Whether bytes without a sign look like STL or OBJ, of which nothing says for sure that they are.
 * @param size of the file; none: it is not known, and binary STL cannot be told
 */
MeshFormat formatOfLooks(std::string_view bytes, std::optional<std::uint64_t> size);

/** The format of a file name's suffix; .gz at its end is left out of account. */
MeshFormat formatOfSuffix(const std::filesystem::path& path);

} // namespace smg
