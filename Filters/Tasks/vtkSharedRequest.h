// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkInputStamp.h"
#include "Filters/Pieces/vtkPieceRequest.h"

#include <optional>

namespace smg
{

/** The last request that all processes have answered together. Process 0, if it is asked for the
 * same once more, does not wait for the others. */
class SharedRequest
{
public:
  /**
   * Whether a request is to be answered together with the other processes. Throws Error if it is
   * streamed and this process is no server, as only process 0 streams.
   */
  bool isShared(const PieceRequest& request, const InputStamp& stamp, bool isServer);

  /** Says that it has been answered, as far as it is not streamed. */
  void noteAnswer(const PieceRequest& request, const InputStamp& stamp);

private:
  /** A request, with what its answer depends on. */
  struct Answered
  {
    InputStamp stamp;
    int piece = 0, pieces = 0;
    bool operator==(const Answered&) const = default;
  };

  std::optional<Answered> Last; ///< that all processes answered together
  /**
   * Whether requests have been streamed since then. They put other pieces in its place in process 0
   * only, which may be asked for the same once more, alone.
   */
  bool HasStreamed = false;
};

} // namespace smg
