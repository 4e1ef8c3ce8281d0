// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMFieldArrayDomain.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

vtkStandardNewMacro(vtkSMFieldArrayDomain);

int vtkSMFieldArrayDomain::IsInDomain(vtkSMProperty* property)
{
  vtkSMUncheckedPropertyHelper input(property);
  const unsigned int count = input.GetNumberOfElements();
  for (unsigned int k = 0; k < count; ++k)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(k));
    vtkPVDataInformation* data =
      source ? source->GetDataInformation(input.GetOutputPort(k)) : nullptr;
    if (!data || !data->GetArrayInformation(this->Array.c_str(), vtkDataObject::FIELD))
    {
      return NOT_IN_DOMAIN;
    }
  }
  return count > 0 ? IN_DOMAIN : NOT_IN_DOMAIN;
}

int vtkSMFieldArrayDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  this->Array = element->GetAttributeOrEmpty("array");
  return this->Superclass::ReadXMLAttributes(property, element);
}

void vtkSMFieldArrayDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Array: " << this->Array << "\n";
}

void smg::addDomains()
{
  vtkClientServerInterpreterInitializer::GetGlobalInterpreter()->AddNewInstanceFunction(
    "vtkSMFieldArrayDomain", [](void*) -> vtkObjectBase* { return vtkSMFieldArrayDomain::New(); });
}
