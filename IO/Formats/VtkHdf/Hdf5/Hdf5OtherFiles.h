// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

// An HDF5 file may name other files, as those of ParaView's parallel writer do. A mesh that comes
// from somebody else must not make a program read files anywhere: only those in its folder, or
// below.

/** Throws Error if a link on the path to an object of a file, called `name`, leads elsewhere. */
void checkLinks(std::int64_t file, const std::string& name, const std::string& object);

/** Throws Error if a dataset with these properties of creation has numbers in a file elsewhere. */
void checkSources(std::int64_t properties, const std::string& name, const std::string& dataset);

} // namespace smg
