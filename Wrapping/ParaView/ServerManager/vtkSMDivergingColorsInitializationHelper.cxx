// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMDivergingColorsInitializationHelper.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkSMDivergingColorsInitializationHelper);

namespace
{

// The largest finite absolute value of a point array; 0 where there is none.
double LargestMagnitude(vtkPVDataInformation* data, const std::string& name)
{
  vtkPVArrayInformation* array = data->GetPointDataInformation()->GetArrayInformation(name.c_str());
  if (!array || array->GetNumberOfComponents() != 1)
  {
    return 0;
  }
  double range[2];
  array->GetComponentFiniteRange(0, range);
  return range[0] <= range[1] ? std::max(std::abs(range[0]), std::abs(range[1])) : 0;
}

// Both, as the range of opacities follows that of colours in ParaView.
void Rescale(vtkSMTransferFunctionManager* manager, vtkSMProxy* colors, const std::string& name,
  double magnitude)
{
  vtkSMProxy* opacities =
    manager->GetOpacityTransferFunction(name.c_str(), colors->GetSessionProxyManager());
  vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, -magnitude, magnitude);
  vtkSMTransferFunctionProxy::RescaleTransferFunction(opacities, -magnitude, magnitude);
}

// Whether the range of a colour map is as far below 0 as above; rescaling moves ends by rounding.
bool IsSymmetric(vtkSMProxy* colors, double range[2])
{
  return vtkSMTransferFunctionProxy::GetRange(colors, range) &&
    std::abs(range[0] + range[1]) <= 1e-9 * std::abs(range[1]);
}

void UpdateColors(vtkSMSessionProxyManager* session, const std::string& name, double magnitude)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* colors = manager->GetColorTransferFunction(name.c_str(), session);
  if (!colors)
  {
    return;
  }
  vtkSMPropertyHelper mode(colors, "AutomaticRescaleRangeMode");
  if (vtkSMPropertyHelper(colors, "ScalarRangeInitialized").GetAsInt() == 0)
  {
    const std::string saved = ".array_lookup_tables." + name + ".PVLookupTable";
    if (vtkSMSettings::GetInstance()->HasSetting(saved.c_str()))
    {
      return;
    }
    mode.Set(vtkSMTransferFunctionManager::GROW_ON_APPLY);
    vtkSMTransferFunctionProxy::ApplyPreset(colors, "Cool to Warm");
    Rescale(manager, colors, name, magnitude);
    return;
  }
  double range[2];
  const bool grows = mode.GetAsInt() == vtkSMTransferFunctionManager::GROW_ON_APPLY ||
    mode.GetAsInt() == vtkSMTransferFunctionManager::GROW_ON_APPLY_AND_TIMESTEP;
  if (grows && IsSymmetric(colors, range) && range[1] < magnitude)
  {
    Rescale(manager, colors, name, magnitude);
  }
}

// Kept by the source proxy as an observer of its updates.
class UpdateObserver : public vtkCommand
{
public:
  static UpdateObserver* New() { return new UpdateObserver; }

  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    auto source = vtkSMSourceProxy::SafeDownCast(caller);
    if (!source || this->Port >= source->GetNumberOfOutputPorts())
    {
      return;
    }
    const std::string name = this->PrefixProperty.empty()
      ? this->Array
      : vtkSMPropertyHelper(source, this->PrefixProperty.c_str()).GetAsString() + this->Array;
    const double magnitude = LargestMagnitude(source->GetDataInformation(this->Port), name);
    if (magnitude > 0)
    {
      UpdateColors(source->GetSessionProxyManager(), name, magnitude);
    }
  }

  std::string Array;
  std::string PrefixProperty;
  unsigned int Port = 0;
};

} // namespace

//------------------------------------------------------------------------------
vtkSMDivergingColorsInitializationHelper::vtkSMDivergingColorsInitializationHelper() = default;

//------------------------------------------------------------------------------
vtkSMDivergingColorsInitializationHelper::~vtkSMDivergingColorsInitializationHelper() = default;

//------------------------------------------------------------------------------
void vtkSMDivergingColorsInitializationHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType)
{
  auto source = vtkSMSourceProxy::SafeDownCast(proxy);
  const char* array = xml->GetAttribute("array");
  if (!source || !array)
  {
    vtkErrorMacro("The hint InitializationHelper of the proxy "
      << proxy->GetXMLName() << (source ? " has no attribute 'array'." : " is no source's."));
    return;
  }
  vtkNew<UpdateObserver> observer;
  observer->Array = array;
  if (const char* prefix = xml->GetAttribute("prefix_property"))
  {
    observer->PrefixProperty = prefix;
  }
  int port = 0;
  if (xml->GetScalarAttribute("port", &port) && port > 0)
  {
    observer->Port = static_cast<unsigned int>(port);
  }
  source->AddObserver(vtkCommand::UpdateDataEvent, observer);
}

//------------------------------------------------------------------------------
void vtkSMDivergingColorsInitializationHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
