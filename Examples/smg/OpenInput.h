// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"
#include "InputOptions.h"

#include "smg/Convert.h"

/** How a mesh file is converted within the memory limit of the options and according to `input`. */
smg::ConversionOptions inputOptions(const CommonOptions& common, const InputOptions& input);

/** Opens a mesh file of any format. A file that is not a stream is converted to `order`, within the
 * memory limit of the options and according to `input`; with a checkpoint, it is kept there. Throws
 * smg::Error. */
std::unique_ptr<smg::OpenedMesh> openInput(const std::filesystem::path& path,
  const CommonOptions& common, smg::ProgressFunction progress,
  smg::StreamOrder order = smg::StreamOrder::BreadthFirst, const InputOptions& input = {});
