// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

// An HDF5 file may refer to other files, like those of ParaView's parallel writer. A foreign mesh
// must not make a program read arbitrary files: only those in its folder or below.

/** Throws Error if a link on the path to an object of the file `name` leads elsewhere. */
void checkLinks(std::int64_t file, const std::string& name, const std::string& object);

/** Throws Error if a dataset with these creation properties has numbers in a file elsewhere. */
void checkSources(std::int64_t properties, const std::string& name, const std::string& dataset);

} // namespace smg
