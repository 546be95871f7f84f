# SPDX-License-Identifier: BSD-3-Clause
"""The pipelines of pipelines.py on a pvserver of several ranks on this machine, at a port that the
system chooses.
"""

import os
from pathlib import Path
import re
import subprocess
import sys
import threading

from paraview import simple


def start_server(command):
    """(process, port): a server that is ready, or an exception with what it printed."""
    # pvpython is an MPI process of its own and has said so in its environment, in which mpiexec would
    # not start another job: the server gets the environment that pvpython was started with.
    words = Path("/proc/self/environ").read_bytes().decode().split("\0")
    environment = dict(word.split("=", 1) for word in words if "=" in word)
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=environment)
    watchdog = threading.Timer(60, server.kill)  # ends the reading below, whatever happens
    watchdog.start()
    printed = ""
    for line in server.stdout:
        printed += line
        found = re.search(r"Accepting connection\(s\): \S+:(\d+)", line)
        if found:
            watchdog.cancel()
            # What it prints later must not fill the pipe.
            threading.Thread(target=server.stdout.read, daemon=True).start()
            return server, int(found.group(1))
    raise RuntimeError(f"no server: {printed}")


if __name__ == "__main__":
    server, port = start_server(sys.argv[1:])
    code = 1
    try:
        simple.Connect("127.0.0.1", port)
        import pipelines

        ranks = simple.servermanager.ActiveConnection.Session.GetServerInformation()
        assert ranks.GetNumberOfProcesses() == pipelines.RANKS, "wrong number of ranks"
        simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=True, ns=vars(simple))
        simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
        for test in pipelines.all_tests():
            test(None)
            print(f"{test.__name__}: ok", flush=True)
        code = 0
        simple.Disconnect()
    finally:
        server.terminate()  # mpiexec passes it on to all ranks
        try:
            server.wait(timeout=20)
        except subprocess.TimeoutExpired:
            server.kill()
    sys.exit(code)
