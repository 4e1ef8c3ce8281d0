// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg
{

struct Format;

/**
 * Refuses a file that its content shows to be something else than a mesh in a format that is read:
 * a web page in place of a download, an archive, text in UTF-16, a mesh of another program ...
 * @param name the name of the file, for the error
 * @param start its first bytes, which have no sign of a format that is read
 * @param wanted the format of its suffix; null if there is none
 * @throws Error "NAME is not a PLY file: it begins with '<!DOCTYPE html>', as a web page does."
 */
void refuseForeign(const std::string& name, std::string_view start, const Format* wanted);

/** The same for a file that should be `kind`, such as "an SMA file". */
void refuseForeign(const std::string& name, std::string_view start, const std::string& kind);

} // namespace smg
