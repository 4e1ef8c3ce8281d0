// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace smg::benchmark
{

/** A conversion to measure. */
struct ConversionTask
{
  std::filesystem::path mesh;    ///< of any format that `smg convert` reads without VTK
  std::filesystem::path output;  ///< a .vsm file, which is kept
  std::filesystem::path scratch; ///< folder for scratch files, which must exist
  std::string order;             ///< like `smg convert --order`
  std::int64_t memory = 0;       ///< limit of the accounted memory, bytes
  std::int64_t addressSpace = 0; ///< most bytes of address space of the process; 0: no limit
};

/**
 * Converts the mesh in a separate process. The result holds the ConversionReport, `cpu_seconds` and
 * `wall_seconds` of the whole process, `peak_bytes` resident, `scratch_bytes_peak` on disk and
 * `output_bytes`; or `{"failed": "why"}`.
 */
nlohmann::json measureConversion(const ConversionTask& task);

} // namespace smg::benchmark
