// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

class vtkSMProxy;

namespace smg
{

/** Calls `take` with each proxy that ParaView has registered and will register, and with its group;
 * that of prototypes ends with "_prototypes". A renamed proxy is registered again. */
void forRegisteredProxies(std::function<void(vtkSMProxy&, const std::string& group)> take);

} // namespace smg
