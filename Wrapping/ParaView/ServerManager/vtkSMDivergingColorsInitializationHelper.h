// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMDivergingColorsInitializationHelper
 * @brief   colours of a signed array: diverging, and as far below 0 as above
 *
 * ParaView colours a new output by its active scalars over the range of the data, which is not
 * symmetric: the neutral colour in the middle of the map would not stand for 0. This helper of a
 * source proxy makes the colour map of one of its point arrays before ParaView does, when the
 * output is first computed, so with any client (the window, pvpython):
 *
 * - where the array has no colour map yet, it gets the preset "Cool to Warm" over [-m, m] with
 *   m the largest finite absolute value, and grows on Apply;
 * - where its map is symmetric about 0 and may grow, later updates let it grow to both sides, so
 *   that it stays symmetric;
 * - other maps are left as they are: those whose range was set by hand or locked, and those that
 *   the user saved as default for arrays of this name.
 *
 * Nothing is done while all values are 0 or there are none.
 *
 * In the hints of a proxy:
 * @code{.xml}
 * <InitializationHelper class="vtkSMDivergingColorsInitializationHelper"
 *                       array="SignedDistance" prefix_property="ArrayNamePrefix" port="0"/>
 * @endcode
 * `array` is the name of the point array; `prefix_property` (optional) names a string property
 * whose value goes before it; `port` (default 0) is the output that is looked at.
 *
 * @sa
 * vtkPointInversionFilter, vtkSMTransferFunctionManager
 */

#ifndef vtkSMDivergingColorsInitializationHelper_h
#define vtkSMDivergingColorsInitializationHelper_h

#include "vtkFootpointServerManagerModule.h" // For export macro
#include "vtkSMProxyInitializationHelper.h"

class VTKFOOTPOINTSERVERMANAGER_EXPORT vtkSMDivergingColorsInitializationHelper
  : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMDivergingColorsInitializationHelper* New();
  vtkTypeMacro(vtkSMDivergingColorsInitializationHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Makes the proxy, which must be a vtkSMSourceProxy, set the colour map after each update.
   */
  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMDivergingColorsInitializationHelper();
  ~vtkSMDivergingColorsInitializationHelper() override;

private:
  vtkSMDivergingColorsInitializationHelper(
    const vtkSMDivergingColorsInitializationHelper&) = delete;
  void operator=(const vtkSMDivergingColorsInitializationHelper&) = delete;
};

#endif
