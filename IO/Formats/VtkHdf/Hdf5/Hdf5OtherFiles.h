// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

// An HDF5 file may name other files. A mesh from an untrusted source must not make a program read
// files anywhere: only virtual datasets are followed, as ParaView's parallel writer makes them, to
// datasets of files in the folder of the file or below.

/** Whether a file, called `name`, has an object. Throws Error if the path to it contains a link
 * that is not a plain (hard) one. */
bool checkLinks(std::int64_t file, const std::string& name, const std::string& object);

/** Throws Error if an open dataset of the file `name` has its numbers anywhere else. */
void checkSources(std::int64_t dataset, const std::string& name, const std::string& object);

} // namespace smg
