// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

void importVtkHdf(InputFile& file, RawMeshBuilder& builder, const MeshPart& part);
std::optional<FileCounts> countsOfVtkHdf(InputFile& file, const MeshPart& part);
/** The times of the time steps; empty: there are none. Throws Error. */
std::vector<double> timesOfVtkHdf(const std::filesystem::path& path);

} // namespace smg
