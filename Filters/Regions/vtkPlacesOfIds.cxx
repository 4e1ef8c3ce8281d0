// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkPlacesOfIds.h"

#include "vtkPointSet.h"

namespace smg
{

PlacesOfIds::PlacesOfIds(const std::vector<std::int64_t>& ids, const SoughtIds& sought)
  : Ids(ids)
  , Sought(sought)
  , Positions(3 * ids.size())
  , IsFound(ids.size(), 0)
{
}

void PlacesOfIds::seek(vtkPointSet& piece, std::span<const std::int64_t> idsOfPoints)
{
  for (std::size_t i = 0; i < idsOfPoints.size(); ++i)
  {
    const std::int64_t number = this->Sought.numberOf(idsOfPoints[i]);
    if (number >= 0)
    {
      piece.GetPoint(static_cast<vtkIdType>(i), this->Positions.data() + 3 * number);
      this->IsFound[number] = 1;
    }
  }
}

std::vector<double> PlacesOfIds::positions() const
{
  std::vector<double> positions;
  positions.reserve(this->Positions.size());
  for (const std::int64_t id : this->Ids)
  {
    const auto first = this->Positions.begin() + 3 * this->Sought.numberOf(id);
    positions.insert(positions.end(), first, first + 3);
  }
  return positions;
}

} // namespace smg
