// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkSharedRequest.h"

#include "smg/Error.h"

namespace smg
{

bool SharedRequest::isShared(const PieceRequest& request, const InputStamp& stamp, bool isServer)
{
  if (request.IsStreamed)
  {
    // The others are not there to answer.
    if (!isServer)
    {
      throw Error("A streamed request reached a process other than 0, which has no solution: "
                  "stream in process 0.");
    }
    this->HasStreamed = true;
    return false;
  }
  if (isServer && this->HasStreamed &&
      this->Last == Answered{ stamp, request.Piece, request.Pieces })
  {
    return false;
  }
  this->HasStreamed = false;
  this->Last.reset();
  return true;
}

void SharedRequest::noteAnswer(const PieceRequest& request, const InputStamp& stamp)
{
  if (!request.IsStreamed)
  {
    this->Last = Answered{ stamp, request.Piece, request.Pieces };
  }
}

} // namespace smg
