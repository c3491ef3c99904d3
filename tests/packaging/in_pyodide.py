"""Derive in a real WebAssembly Python: Pyodide under Node, with the wheels that a browser would load.

    python -m tests.packaging.in_pyodide        (needs node, npm and the package indexes)

Pyodide comes from npm, python-flint's wheel for Emscripten and the pure Python wheels from the index, Ridgeback's own
wheel is built from this tree; nothing else is installed, not even NumPy.  Each command is held against what the same
command prints here.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

from tests.packaging.processes import ROOT, run

COMMANDS: Sequence[tuple[str, ...]] = (
    ("systems",),
    ("derive", "pendulum", "--order", "12", "--verify"),
    ("derive", "pendulum", "--at", "1,2", "--digits", "30"),
    ("derive", "van-der-pol", "--order", "8", "--format", "json"),
    ("derive", "damped-duffing-hardening", "--method", "multiple-scales", "--order", "6"),
    ("derive", "--equation", "m*x'' + k*x + k3*x**3 = 0", "--order", "6"),
    ("derive", "--equation", "u'' + u + u*abs(u)/3 = 0", "--order", "4"),
)
PURE = ("sympy", "mpmath", "click")
HOST = """
import { loadPyodide } from "pyodide";
const [site, commands] = process.argv.slice(2);
let printed = "";
const python = await loadPyodide({ stdout: line => { printed += line + "\\n"; }, stderr: line => console.error(line) });
python.mountNodeFS("/site", site);
const results = [];
for (const words of JSON.parse(commands)) {
  printed = "";
  python.globals.set("words", python.toPy(words));
  const code = python.runPython(`
import sys
if "/site" not in sys.path:
    sys.path.insert(0, "/site")
from ridgeback.cli import main
try:
    main(list(words))
    code = 0
except SystemExit as end:
    code = int(end.code or 0)
sys.stdout.flush()
code
`);
  results.push([code, printed]);
}
console.log(JSON.stringify({ version: python.version, results }));
"""


def downloaded(folder: Path) -> None:
    """The wheels of a browser, unpacked in ``folder/site``."""
    wheels = folder / "wheels"
    pip = (sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "-d", wheels)
    run(*pip, "--only-binary=:all:", *PURE, cwd=folder)
    lock = json.loads((folder / "node_modules" / "pyodide" / "pyodide-lock.json").read_text(encoding="utf-8"))["info"]
    python = "".join(lock["python"].split(".")[:2])
    platform = (f"--platform=pyemscripten_{lock['abi_version']}_wasm32", "--implementation=cp")
    version = (f"--python-version={python}", f"--abi=cp{python}")
    run(*pip, *platform, *version, "--only-binary=:all:", "python-flint", cwd=folder)
    run(sys.executable, "-m", "build", "--wheel", "--outdir", wheels, ROOT, cwd=folder)
    for wheel in wheels.glob("*.whl"):
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(folder / "site")


def here(words: Sequence[str], folder: Path) -> tuple[int, str]:
    """What a command ends with and prints in this Python."""
    command = [sys.executable, "-m", "ridgeback", *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def main() -> int:
    """Install, run there and here, compare; 1 where they differ."""
    with tempfile.TemporaryDirectory(prefix="ridgeback-pyodide-") as name:
        folder = Path(name)
        run("npm", "install", "--silent", "--prefix", folder, "pyodide", cwd=folder)
        downloaded(folder)
        (folder / "host.mjs").write_text(HOST, encoding="utf-8")
        there = json.loads(run("node", "host.mjs", folder / "site", json.dumps(COMMANDS), cwd=folder).splitlines()[-1])
        differ = 0
        for words, (code, printed) in zip(COMMANDS, there["results"], strict=True):
            same = (code, printed) == here(words, folder)
            differ += not same
            print(f"{'the same' if same else f'different (exit code {code})'}: ridgeback {' '.join(words)}")
        alike = f"{len(COMMANDS) - differ} of {len(COMMANDS)} commands"
        print(f"Pyodide {there['version']}: {alike} print what they print here")
    return int(differ > 0)


if __name__ == "__main__":
    sys.exit(main())
