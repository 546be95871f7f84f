# SPDX-License-Identifier: BSD-3-Clause
"""Runs a Python program inside ParaView's window, on a display of its own:

    FOOTPOINT_PLUGIN=<path of Footpoint.so> python3 start.py <program> [argument...]

The plugin is loaded as PV_PLUGIN_PATH loads it; settings are ParaView's own defaults. Prints what the
program prints, and exits with its code; with 125 and a reason where the window cannot be shown, and
with 1 where the program has not ended after 500 seconds. FOOTPOINT_PARAVIEW is the path of ParaView,
if it is not on PATH.
"""

import importlib.util
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile

SKIP = 125
SECONDS = 500
SCREEN = "1400x1000x24"

#: What ParaView runs: os._exit, as there is nothing to save and nobody to ask.
BOOTSTRAP = """\
import os, runpy, sys, traceback
log = open({log!r}, "w", buffering=1, encoding="utf-8")
sys.stdout = sys.stderr = log
sys.argv = {argv!r}
sys.path.insert(0, {here!r})
code = 0
try:
    runpy.run_path(sys.argv[0], run_name="__main__")
except SystemExit as exit:
    code = exit.code if isinstance(exit.code, int) else bool(exit.code)
    if isinstance(exit.code, str):
        print(exit.code)
except BaseException:
    traceback.print_exc()
    code = 1
log.flush()
os._exit(code)
"""


def missing(paraview):
    """Why the window cannot be shown, or None."""
    if not paraview or not Path(paraview).exists():
        return "no ParaView: set FOOTPOINT_PARAVIEW"
    if not shutil.which("Xvfb"):
        return "no Xvfb: apt-get install xvfb"
    if importlib.util.find_spec("PyQt5") is None:
        return "no PyQt5: apt-get install python3-pyqt5"
    return None


def start_display():
    """An X server on a free display: (process, ":number")."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", SCREEN, "-nolisten", "tcp",
         "-noreset"], pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    if not number:
        server.kill()
        sys.exit("Xvfb did not start")
    return server, f":{number}"


def write_settings(home):
    """A home without a welcome."""
    folder = home / ".config" / "ParaView"
    folder.mkdir(parents=True)
    (folder / "ParaView5.11.0.ini").write_text(
        "[General]\nGeneralSettings.ShowWelcomeDialog=false\n", encoding="utf-8")


def run(paraview, program, display, scratch):
    """The exit code of the program."""
    home, log, script = scratch / "home", scratch / "log", scratch / "bootstrap.py"
    write_settings(home)
    here = str(Path(__file__).resolve().parent)
    script.write_text(
        BOOTSTRAP.format(log=str(log), argv=program, here=here), encoding="utf-8")
    environment = dict(
        os.environ, DISPLAY=display, HOME=str(home), XDG_CONFIG_HOME=str(home / ".config"),
        XDG_RUNTIME_DIR=str(home), QT_SCALE_FACTOR="1", QT_STYLE_OVERRIDE="Fusion",
        PV_PLUGIN_PATH=str(Path(os.environ["FOOTPOINT_PLUGIN"]).resolve().parent))
    home.chmod(0o700)
    window = subprocess.Popen([str(paraview), f"--script={script}"], env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        output, _ = window.communicate(timeout=SECONDS)
        code = window.returncode
    except subprocess.TimeoutExpired:
        window.kill()
        output, _ = window.communicate()
        print(f"ParaView did not end within {SECONDS} s")
        code = 1
    if log.exists():
        print(log.read_text(encoding="utf-8"), end="")
    if code != 0:
        print(output.decode(errors="replace"))
    return code


def main():
    if len(sys.argv) < 2 or "FOOTPOINT_PLUGIN" not in os.environ:
        sys.exit(__doc__)
    paraview = os.environ.get("FOOTPOINT_PARAVIEW") or shutil.which("paraview")
    reason = missing(paraview)
    if reason:
        print(f"skipped: {reason}")
        sys.exit(SKIP)
    program = [str(Path(sys.argv[1]).resolve()), *sys.argv[2:]]
    server, display = start_display()
    try:
        with tempfile.TemporaryDirectory() as scratch:
            code = run(paraview, program, display, Path(scratch))
    finally:
        server.terminate()
        server.wait()
    sys.exit(1 if code < 0 else code)


if __name__ == "__main__":
    main()
