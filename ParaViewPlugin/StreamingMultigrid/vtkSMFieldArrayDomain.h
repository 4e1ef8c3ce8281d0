// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMFieldArrayDomain
 * @brief   Data with a certain array in their field data
 *
 * Of an input property in the XML of a proxy: `<FieldArrayDomain name="..." array="NAME"/>` accepts
 * the output of a filter whose field data have the array NAME. The writers of the plugin know by it
 * the previews of readers, and what failed filters deliver.
 */
#ifndef vtkSMFieldArrayDomain_h
#define vtkSMFieldArrayDomain_h

#include "vtkSMDomain.h"

#include <string> // For std::string

class vtkSMFieldArrayDomain : public vtkSMDomain
{
public:
  static vtkSMFieldArrayDomain* New();
  vtkTypeMacro(vtkSMFieldArrayDomain, vtkSMDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int IsInDomain(vtkSMProperty* property) override;

protected:
  vtkSMFieldArrayDomain() = default;
  ~vtkSMFieldArrayDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMFieldArrayDomain(const vtkSMFieldArrayDomain&) = delete;
  void operator=(const vtkSMFieldArrayDomain&) = delete;

  std::string Array;
};

namespace smg
{

/** Makes ParaView know our domains, which the XML of proxies names. Called when the plugin is
 * loaded. */
void addDomains();

} // namespace smg

#endif
