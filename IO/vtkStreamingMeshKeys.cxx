// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkStreamingMeshKeys.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

/** The executive compares a request key with what the data object says under another key. */
class StreamedKey : public vtkInformationIntegerRequestKey
{
public:
  StreamedKey(const char* name, const char* location)
    : vtkInformationIntegerRequestKey(name, location)
  {
    this->DataKey = vtkStreamingMeshKeys::STREAMED_DATA();
  }
};

} // namespace

vtkStandardNewMacro(vtkStreamingMeshKeys);
vtkInformationKeyMacro(vtkStreamingMeshKeys, STREAMED_DATA, Integer);

static vtkInformationIntegerRequestKey* vtkStreamingMeshKeys_STREAMED =
  new StreamedKey("STREAMED", "vtkStreamingMeshKeys");

vtkInformationIntegerRequestKey* vtkStreamingMeshKeys::STREAMED()
{
  return vtkStreamingMeshKeys_STREAMED;
}

bool vtkStreamingMeshKeys::IsStreamed(vtkInformation* info)
{
  return info->Has(STREAMED()) && info->Get(STREAMED()) > 0 &&
         info->Get(STREAMED()) ==
           info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
}

void vtkStreamingMeshKeys::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
