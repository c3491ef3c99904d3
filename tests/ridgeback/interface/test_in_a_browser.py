"""The core works where Python runs in a browser: no h5py, no thread or process can be started, modules missing.

What is taken away here is what Pyodide takes away from CPython.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

GONE = (
    *("h5py", "openpyxl", "pandas", "xarray", "heyoka", "distributed", "_multiprocessing"),
    *("curses", "dbm", "ensurepip", "fcntl", "grp", "pwd", "resource", "syslog", "termios", "tkinter", "venv"),
)
"""Libraries that need not be there, and modules that Emscripten's Python does not have."""

SETTING = f"""
import sys, threading
for name in {GONE!r}:
    sys.modules[name] = None

def refused(*_, **__):
    raise RuntimeError("can't start new thread")

def unsupported(*_, **__):
    raise OSError(138, "emscripten does not support processes.")

threading.Thread.start = refused
import os, subprocess
subprocess.Popen.__init__ = unsupported
for name in ("fork", "posix_spawn", "posix_spawnp", "forkpty", "system"):
    if hasattr(os, name):
        setattr(os, name, unsupported)
import ridgeback
"""

WORK = {
    "derive": """
assert str(ridgeback.derive("u'' + u + c*u**3 = 0", 4).frequency[2]) == "3*c/8"
flow = ridgeback.derive("damped pendulum", 4)
assert "growth_rate" in flow.to_dict()
""",
    "prove and generate": """
series = ridgeback.derive("pendulum", 8)
assert ridgeback.certified_frequencies("pendulum", series, [1])
assert "double" in ridgeback.generate(series, "c")
""",
    "simulate and estimate": """
run = ridgeback.simulate("damped_pendulum", (1.0, 0.0), duration=80.0, rate=5.0)
curve = ridgeback.backbone(run.u, 5.0)
assert curve.rows()
plane = ridgeback.spectrogram(run.u, 5.0, window_seconds=20.0)
""",
    "the command line": """
from ridgeback.cli import main
assert main(["derive", "van-der-pol", "--order", "4"]) == 0
assert main(["doctor"]) == 0
""",
}


@pytest.mark.parametrize("task", WORK)
def test_it_works_without_what_a_browser_does_not_have(task: str) -> None:
    done = subprocess.run([sys.executable, "-c", SETTING + WORK[task]], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_file_that_needs_what_is_not_there_says_so(tmp_path: Path) -> None:
    file = tmp_path / "rig.h5"
    file.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(64))
    code = f"{SETTING}\nfrom ridgeback.cli import main\nsys.exit(main(['estimate', {str(file)!r}]))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode in (2, 4)
    assert "h5py" in done.stderr
    assert done.stderr.count("\n") == 1
