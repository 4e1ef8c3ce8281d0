// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshKeys.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVariantKey.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

/** The executive compares a request key with the value of another key in the data object. */
class StreamedKey : public vtkInformationIntegerRequestKey
{
public:
  StreamedKey(const char* name, const char* location)
    : vtkInformationIntegerRequestKey(name, location)
  {
    this->DataKey = vtkStreamingMeshKeys::STREAMED_DATA();
  }
};

/** All filters pass it downstream, including those that do not know it. */
template <class Key>
class PassedKey : public Key
{
public:
  using Key::Key;

  void CopyDefaultInformation(
    vtkInformation* request, vtkInformation* from, vtkInformation* to) override
  {
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      this->ShallowCopy(from, to);
    }
  }
};

} // namespace

vtkStandardNewMacro(vtkStreamingMeshKeys);
vtkInformationKeyMacro(vtkStreamingMeshKeys, STREAMED_DATA, Integer);
vtkInformationKeyMacro(vtkStreamingMeshKeys, CANCELLED, Integer);
vtkInformationKeyMacro(vtkStreamingMeshKeys, ISOLATED_VALUE, Variant);
vtkInformationKeyMacro(vtkStreamingMeshKeys, FORMER_SCALARS, Variant);

static vtkInformationIntegerRequestKey* vtkStreamingMeshKeys_STREAMED =
  new StreamedKey("STREAMED", "vtkStreamingMeshKeys");

vtkInformationIntegerRequestKey* vtkStreamingMeshKeys::STREAMED()
{
  return vtkStreamingMeshKeys_STREAMED;
}

static vtkInformationStringKey* vtkStreamingMeshKeys_STREAM_FILE =
  new PassedKey<vtkInformationStringKey>("STREAM_FILE", "vtkStreamingMeshKeys");
static vtkInformationStringKey* vtkStreamingMeshKeys_STREAM_FINGERPRINT =
  new PassedKey<vtkInformationStringKey>("STREAM_FINGERPRINT", "vtkStreamingMeshKeys");
static vtkInformationIntegerKey* vtkStreamingMeshKeys_PREVIEWED =
  new PassedKey<vtkInformationIntegerKey>("PREVIEWED", "vtkStreamingMeshKeys");

vtkInformationStringKey* vtkStreamingMeshKeys::STREAM_FILE()
{
  return vtkStreamingMeshKeys_STREAM_FILE;
}

vtkInformationStringKey* vtkStreamingMeshKeys::STREAM_FINGERPRINT()
{
  return vtkStreamingMeshKeys_STREAM_FINGERPRINT;
}

vtkInformationIntegerKey* vtkStreamingMeshKeys::PREVIEWED()
{
  return vtkStreamingMeshKeys_PREVIEWED;
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
