// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/JsonAt.h"

#include <nlohmann/json.hpp>

namespace smg::testing
{

namespace
{

nlohmann::json valueAt(const std::string& text, const std::string& place)
{
  return nlohmann::json::parse(text).at(nlohmann::json::json_pointer(place));
}

} // namespace

std::string jsonAt(const std::string& text, const std::string& place)
{
  return valueAt(text, place).dump();
}

double numberAt(const std::string& text, const std::string& place)
{
  return valueAt(text, place).get<double>();
}

} // namespace smg::testing
