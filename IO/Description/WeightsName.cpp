// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/WeightsName.h"

namespace smg
{

std::optional<Weights> weightsOfName(std::string_view name)
{
  if (name == "cotangent" || name == "raw-cotangent")
  {
    return Weights::Cotangent;
  }
  if (name == "clamped")
  {
    return Weights::Clamped;
  }
  return name == "uniform" ? std::optional(Weights::Uniform) : std::nullopt;
}

std::optional<Weights> parseWeights(const JsonNode& object)
{
  if (!object.has("weights"))
  {
    return std::nullopt;
  }
  const JsonNode node = object.member("weights");
  const std::optional<Weights> weights = weightsOfName(node.string());
  if (!weights)
  {
    node.fail("must be \"cotangent\", \"clamped\" or \"uniform\"");
  }
  return weights;
}

} // namespace smg
