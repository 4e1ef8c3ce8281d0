// SPDX-License-Identifier: BSD-3-Clause
#include "OpenInput.h"

#include <utility>

smg::ConversionOptions inputOptions(const CommonOptions& common, const InputOptions& input)
{
  smg::ConversionOptions options;
  input.applyTo(options);
  options.memoryLimit = common.memoryBytes(0);
  options.codec = smg::Codec::Lz4;
  options.scratch = common.scratch;
  options.threads = common.threads;
  return options;
}

std::unique_ptr<smg::OpenedMesh> openInput(const std::filesystem::path& path,
  const CommonOptions& common, smg::ProgressFunction progress, smg::StreamOrder order,
  const InputOptions& input)
{
  smg::ConversionOptions options = inputOptions(common, input);
  options.order = order;
  options.checkpoint = common.checkpoint;
  options.progress = std::move(progress);
  return smg::openMesh(path, options);
}
