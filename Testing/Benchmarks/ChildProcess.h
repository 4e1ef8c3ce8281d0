// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace smg::benchmark
{

/** Runs `work` in a child process, so that its memory is measured separately, and returns its
 * result. If the child throws or dies, the result is `{"failed": "why"}`. */
nlohmann::json runInChild(const std::function<nlohmann::json()>& work);

} // namespace smg::benchmark
