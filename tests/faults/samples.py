"""The folder that every case starts in: whole and damaged files of every kind that is read, made from fixed numbers."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from tests.faults.cases import study_files
from tests.faults.formats import TIME, U, bomb, decay, hdf5, mat, npy, npz, npz_of_nothing, patched, table, wav

TEXTS: Mapping[str, str] = {
    "decay.csv": decay(),
    "two.csv": decay(2, head="time_s,u,v"),
    "semicolon.csv": decay(head="time_s;u").replace(",", ";").replace(".", ","),
    "headless.csv": decay().split("\n", 1)[1],
    "headless-values.csv": "\n".join(line.partition(",")[2] for line in decay(2).splitlines()[1:]) + "\n",
    "empty.csv": "",
    "blank.csv": "\n\n\n",
    "header.csv": "time_s,u\n",
    "one.csv": "time_s,u\n0,1\n",
    "short.csv": "time_s,u\n0,1\n1,0\n2,-1\n",
    "nan.csv": table((i, "nan" if i % 9 == 8 else i % 3) for i in range(99)),
    "all_nan.csv": table((i, "nan") for i in range(99)),
    "infinite.csv": table((i, "inf" if i == 1 else i % 3) for i in range(60)),
    "huge.csv": table((i, f"{(-1) ** i}e308") for i in range(60)),
    "irregular.csv": table((i + (0.4 if i % 5 == 0 else 0), i % 3) for i in range(60)),
    "duplicate.csv": table((i - (i > 30), i % 3) for i in range(60)),
    "backwards.csv": table((-i, i % 3) for i in range(60)),
    "still.csv": table((0, i % 3) for i in range(60)),
    "constant.csv": table((i, 5) for i in range(60)),
    "words.csv": "time_s,u\n0,one\n1,two\n",
    "ragged.csv": "time_s,u\n0,1\n1\n2,3\n",
    "wide.csv": "time_s,u\n0,1\n1,2,9\n2,3\n",
    "twice.csv": decay(2, head="time_s,u,u"),
    "unnamed.csv": decay(head="time_s,"),
    "underscore.csv": table((i, f"1_0{i % 7}") for i in range(60)),
    "hexadecimal.csv": table((i, f"0x{i % 7}") for i in range(60)),
    "quote.csv": 'time_s,u\n0,"1\n1,2\n',
    "lone_returns.csv": "time_s,u\r0,1\r1,2\r",
    "html.csv": "<html><body>not a table</body></html>\n",
    "json.csv": json.dumps({"time_s": [0, 1], "u": [1, 2]}),
    "code.csv": "time_s,u\n0,__import__('os').system('touch stolen')\n1,2\n",
    "escape.csv": decay(head="time_s,\x1b[31mred\x07"),
    "formula.csv": decay(head="time_s,=cmd|' /C calc'!A0"),
    **study_files.TEXTS,
    "cells.toml": "study.ask = 'error'\ngrid = {orders = [2], amplitudes = [1]}\noscillator = [{system = 'duffing'}]\n",
}

BYTES: Mapping[str, Callable[[], bytes]] = {
    "latin.csv": lambda: "time_s,\xfcber\n0,1\n".encode("latin-1"),
    "utf16.csv": lambda: decay().encode("utf-16"),
    "nul.csv": lambda: b"\x00\x01\x02",
    "binary.csv": lambda: bytes(range(256)) * 4,
    "bom.csv": lambda: b"\xef\xbb\xbf" + decay().encode(),
    "decay.npz": lambda: npz(time=TIME, u=U),
    "cut.npz": lambda: npz(time=TIME, u=U)[:700],
    "empty.npz": lambda: b"",
    "none.npz": npz_of_nothing,
    "objects.npz": lambda: npz(u=np.array([{"a": 1}, None], dtype=object)),
    "strings.npz": lambda: npz(u=np.array(["a", "b"])),
    "complex.npz": lambda: npz(u=U + 1j),
    "unequal.npz": lambda: npz(time=TIME, u=U[:-3]),
    "cube.npz": lambda: npz(u=np.zeros((4, 4, 4))),
    "bomb.npz": bomb,
    "traversal.npz": lambda: npz(**{"../../stolen": U, "time": TIME}),
    "decay.npy": lambda: npy(U),
    "cut.npy": lambda: npy(U)[:200],
    "object.npy": lambda: npy(np.array([{"a": 1}], dtype=object)),
    "magic.npy": lambda: b"\x93NUMPY\x09\x00" + npy(U)[8:],
    "header.npy": lambda: npy(U).replace(b"'shape': (400,)", b"'shape': (4**9,"),
    "evil.npy": lambda: npy(U).replace(b"'fortran_order': False", b"'fortran_order': exit(9"),
    "scalar.npy": lambda: npy(np.array(3.0)),
    "large.npy": lambda: npy(U).replace(b"(400,), }           ", b"(400000000000,), }  "),
    "decay.wav": wav,
    "cut.wav": lambda: wav()[:20],
    "short.wav": lambda: wav()[:60],
    "riff.wav": lambda: b"RIFF" + b"\xff" * 60,
    "no_channels.wav": lambda: patched(wav(), 22, struct.pack("<H", 0)),
    "no_bits.wav": lambda: patched(wav(), 34, struct.pack("<H", 0)),
    "odd_bits.wav": lambda: patched(wav(), 34, struct.pack("<H", 13)),
    "no_format.wav": lambda: wav().replace(b"fmt ", b"fmx "),
    "no_data.wav": lambda: wav().replace(b"data", b"dada"),
    "no_rate.wav": lambda: patched(wav(), 24, struct.pack("<I", 0)),
    "mp3.wav": lambda: patched(wav(), 20, struct.pack("<H", 0x55)),
    "decay.mat": mat,
    "cut.mat": lambda: mat()[:900],
    "header.mat": lambda: mat()[:128],
    "text.mat": lambda: b"% a MATLAB script\nx = 1;\n",
    "words.mat": lambda: mat(u=np.array(["a", "bc"])),
    "cells.mat": lambda: mat(u=np.array([[1, "b"]], dtype=object)),
    "size.mat": lambda: patched(mat(), 132, b"\xff\xff\xff\x7f"),
    "version.mat": lambda: patched(mat(), 124, b"\x00\x09"),
    "cut.h5": lambda: hdf5()[:600],
    "signature.h5": lambda: b"\x89HDF\r\n\x1a\n",
    "text.h5": lambda: b"time_s,u\n0,1\n",
    "zeroed.h5": lambda: patched(hdf5(), 96, bytes(200)),
    "words.h5": lambda: hdf5(u=np.array([b"a", b"b"])),
    "decay.h5": hdf5,
    "nothing.h5": lambda: hdf5(u=None),
    "notes.docx": lambda: b"PK\x03\x04 not a table at all",
    "picture.png": lambda: b"\x89PNG\r\n\x1a\n" + bytes(64),
}

OSCILLATORS: Mapping[str, str] = {
    "good.toml": "[oscillator]\nequation = \"x'' + x + x**3 = 0\"\n",
    "with_initial.toml": "[oscillator]\nequation = \"x'' + x + x**3 = 0\"\ninitial = [1.0, 0.0]\n",
    "symbolic.toml": "[oscillator]\nequation = \"x'' + x + c*x**3 = 0\"\n",
    "empty.toml": "",
    "no_table.toml": "equation = \"x'' + x = 0\"\n",
    "no_equation.toml": '[oscillator]\ntitle = "t"\n',
    "number.toml": "[oscillator]\nequation = 5\n",
    "list.toml": "oscillator = [1, 2]\n",
    "unknown_key.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ncolour = 3\n",
    "unclosed.toml": '[oscillator]\nequation = "x',
    "twice.toml": "[oscillator]\nequation = \"x'' + x = 0\"\nequation = \"x'' + x = 0\"\n",
    "two_tables.toml": "[oscillator]\nequation = \"x'' + x = 0\"\n[oscillator]\ntitle = 'a'\n",
    "title.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ntitle = 3\n",
    "initial_one.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ninitial = [1]\n",
    "initial_text.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ninitial = ['a', 'b']\n",
    "initial_nan.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ninitial = [nan, 0.0]\n",
    "initial_inf.toml": "[oscillator]\nequation = \"x'' + x = 0\"\ninitial = [inf, 0.0]\n",
    "parameter_text.toml": "[oscillator]\nequation = \"x'' + k*x = 0\"\n[oscillator.parameters]\nk = 'abc'\n",
    "parameter_nan.toml": "[oscillator]\nequation = \"x'' + k*x = 0\"\n[oscillator.parameters]\nk = nan\n",
    "parameter_list.toml": "[oscillator]\nequation = \"x'' + k*x = 0\"\n[oscillator.parameters]\nk = [1]\n",
    "parameter_bool.toml": "[oscillator]\nequation = \"x'' + k*x = 0\"\n[oscillator.parameters]\nk = true\n",
    "parameter_other.toml": "[oscillator]\nequation = \"x'' + k*x = 0\"\n[oscillator.parameters]\nk = 1\nq = 2\n",
    "parameters_list.toml": "[oscillator]\nequation = \"x'' + x = 0\"\nparameters = [1]\n",
    "potential.toml": '[oscillator]\nequation = "x\'\' + x = 0"\npotential = "x**2"\n',
    "potential_text.toml": "[oscillator]\nequation = \"x'' + x = 0\"\npotential = \"eval('1')\"\n",
    "about.toml": '[oscillator]\nequation = "x\'\' + x = 0"\nabout = "2"\n',
    "about_number.toml": "[oscillator]\nequation = \"x'' + x = 0\"\nabout = 2\n",
    "about_symbol.toml": '[oscillator]\nequation = "x\'\' + x = 0"\nabout = "k"\n',
    "code.toml": "[oscillator]\nequation = \"x'' + __import__('os').system('touch stolen') = 0\"\n",
    "date.toml": "[oscillator]\nequation = 1979-05-27\n",
    "nested.toml": "a = " + "[" * 20000 + "]" * 20000 + "\n",
    "long.toml": "# " + "x" * 200_000,
    "spaces in name.toml": "[oscillator]\nequation = \"x'' + x + x**3 = 0\"\n",
}


def write_samples(folder: Path) -> None:
    """Write all of them, and a folder whose name ends like a file's, a link that loops and one that leads nowhere."""
    for name, text in {**TEXTS, **OSCILLATORS}.items():
        (folder / name).write_text(text, encoding="utf-8", newline="")
    for name, content in BYTES.items():
        (folder / name).write_bytes(content())
    (folder / "latin.toml").write_bytes("[oscillator]\nequation = \"x'' + x = 0\"\ntitle = '\xfc'\n".encode("latin-1"))
    (folder / "folder.csv").mkdir()
    (folder / "folder.toml").mkdir()
    (folder / "loop.csv").symlink_to("loop.csv")
    (folder / "loop.toml").symlink_to("loop.toml")
    (folder / "nowhere.csv").symlink_to("no such file")
    (folder / "linked.csv").symlink_to("decay.csv")
    (folder / "other_name.csv").hardlink_to(folder / "decay.csv")
    (folder / "zero.toml").symlink_to("/dev/zero")
    (folder / "zero.csv").symlink_to("/dev/zero")
    kept = folder / "kept.csv"
    kept.write_text("do not touch\n", encoding="utf-8")
    kept.chmod(0o444)
