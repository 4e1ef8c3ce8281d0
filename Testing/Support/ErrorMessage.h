// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <gtest/gtest.h>

#include <string>

namespace smg::testing
{

inline bool contains(const std::string& sentence, const std::string& part)
{
  return sentence.find(part) != std::string::npos;
}

/** The message of the Error that `action` throws; empty if there is none. */
std::string messageOf(const auto& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

/** Expects `action` to throw an Error whose message contains `part`. */
void expectError(const auto& action, const std::string& part)
{
  const std::string message = messageOf(action);
  EXPECT_NE(message.find(part), std::string::npos) << "got: '" << message << "'";
}

} // namespace smg::testing
