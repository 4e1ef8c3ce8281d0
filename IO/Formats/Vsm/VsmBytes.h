// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace smg
{

class VsmFile;

/** Bytes of columns of a .vsm file that zstd compresses, by table (VsmFormat::Table) and name. */
using VsmParts = std::map<std::pair<int, std::string>, std::int64_t>;

/** Those of a file; none if it is compressed in another way. */
VsmParts vsmParts(const VsmFile& file);

/** About the bytes of a mesh as a .vsm file, in which the columns `known` have as many. */
std::int64_t vsmBytes(const StreamInfo& mesh, Codec codec, const VsmParts& known = {});

} // namespace smg
