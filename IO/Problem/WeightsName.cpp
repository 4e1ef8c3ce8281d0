// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/WeightsName.h"

namespace smg
{

std::optional<Weights> weightsOfName(std::string_view name)
{
  if (name == "cotangent")
  {
    return Weights::Cotangent;
  }
  if (name == "raw-cotangent")
  {
    return Weights::RawCotangent;
  }
  return name == "uniform" ? std::optional(Weights::Uniform) : std::nullopt;
}

std::optional<Weights> parseWeights(const JsonNode& object, bool raw)
{
  if (!object.has("weights"))
  {
    return std::nullopt;
  }
  const JsonNode node = object.member("weights");
  const std::optional<Weights> weights = weightsOfName(node.string());
  if (!weights || (!raw && weights == Weights::RawCotangent))
  {
    node.fail(raw ? "must be \"cotangent\", \"raw-cotangent\" or \"uniform\""
                  : "must be \"cotangent\" or \"uniform\"");
  }
  return weights;
}

} // namespace smg
