# SPDX-License-Identifier: BSD-3-Clause
"""The pipelines of pipelines.py in pvbatch: on rank 0, whose satellites do as it says, or with
--symmetric on every rank.
"""

import os

from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from ranks import run

if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    import pipelines

    run(pipelines.all_tests(), vtkMultiProcessController.GetGlobalController(), together=False)
