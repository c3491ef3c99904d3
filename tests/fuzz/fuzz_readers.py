"""Seeded damage to files of every kind that is read; not collected by pytest.

    python -m tests.fuzz.fuzz_readers --seconds 30 --seed 1

Whatever the bytes, a reader gives its values, or an InputError or OSError in one printable line.  Anything else ends
the run: another exception, a crash of the process, more than 20 s or 4 GB.  The file that did it is kept and named.
"""

from __future__ import annotations

import argparse
import faulthandler
import hashlib
import json
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from tests.faults.formats import TIME, U, decay, hdf5, mat, npy, npz, wav

LONGEST = 20.0
MEMORY = 4 << 30
EDGES = tuple(
    bytes.fromhex(text) for text in ("00", "ff", "7f", "80", "01", "ffffffff", "00000080", "ffffff7f", "00" * 8)
)
WORDS = "nan inf 1e999 -1 0 1_0 0x1 , ; \t \n \r \" ' [[ ]] = # {} \\u0000 \xe9 \ufeff true 1979-05-27 (1 ** u''"
TOKENS = tuple(text.encode() for text in WORDS.split(" "))
Rng = random.Random
Reader = Callable[[Path], object]


def damaged(data: bytes, rng: Rng) -> bytes:
    """The bytes after one to four changes."""
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        data = rng.choice(CHANGES)(data, rng)
    return data


def place(data: bytes, rng: Rng) -> int:
    """A place in the bytes, more often near the beginning, where headers are."""
    size = len(data) if rng.random() < 0.4 else min(len(data), rng.choice((16, 64, 256, 1024)))
    return rng.randrange(size) if size else 0


def flip(data: bytes, rng: Rng) -> bytes:
    """One bit the other way."""
    i = place(data, rng)
    return data[:i] + bytes([data[i] ^ (1 << rng.randrange(8))]) + data[i + 1 :] if data else data


def edge(data: bytes, rng: Rng) -> bytes:
    """The largest, the smallest, the sign: values at which sizes overflow."""
    i, new = place(data, rng), rng.choice(EDGES)
    return data[:i] + new + data[i + len(new) :]


def cut(data: bytes, rng: Rng) -> bytes:
    """The end is missing."""
    return data[: place(data, rng)]


def without(data: bytes, rng: Rng) -> bytes:
    """Some bytes in the middle are missing."""
    i = place(data, rng)
    return data[:i] + data[i + rng.choice((1, 2, 8, 100)) :]


def twice(data: bytes, rng: Rng) -> bytes:
    """A piece stands twice."""
    i = place(data, rng)
    return data[: i + rng.choice((1, 8, 64))] + data[i:]


def token(data: bytes, rng: Rng) -> bytes:
    """A word that means something to a reader of text."""
    i = place(data, rng)
    return data[:i] + rng.choice(TOKENS) + data[i + rng.choice((0, 1, 5)) :]


def noise(data: bytes, rng: Rng) -> bytes:
    """Random bytes over a piece."""
    i, n = place(data, rng), rng.choice((4, 16, 64))
    return data[:i] + rng.randbytes(n) + data[i + n :]


CHANGES = (flip, flip, edge, edge, cut, without, twice, token, noise)


def resigned(data: bytes, rng: Rng) -> bytes:
    """A damaged checkpoint with the digest that fits it, so that its reader is met and not its seal."""
    body = b"".join(damaged(data, rng).splitlines(keepends=True)[:-1])
    return body + (json.dumps({"sha256": hashlib.sha256(body).hexdigest()}) + "\n").encode()


def as_recording(path: Path) -> object:
    """Read all signals of a file, as ``estimate --column all`` does."""
    from ridgeback.numeric.recording.reading import read_recordings

    return read_recordings([path], columns="all", rate=None if path.suffix == ".csv" else 32.0)


def as_oscillator(path: Path) -> object:
    """Read a description."""
    from ridgeback.symbolic.systems.description import read_description

    return read_description(path)


def as_balls(path: Path) -> object:
    """Go on from a checkpoint of a derivation in balls."""
    from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls

    return lindstedt_in_balls("van-der-pol", 8, digits=10, checkpoint=path)


def checkpoints(folder: Path) -> dict[str, tuple[bytes, Reader]]:
    """Whole checkpoints, as the program writes them."""
    as_balls(folder / "balls.state")
    return {"balls.state": ((folder / "balls.state").read_bytes(), as_balls)}


def seeds(folder: Path) -> Mapping[str, tuple[bytes, Reader]]:
    """A whole file of each kind and what reads it."""
    recordings = {
        "text.csv": decay().encode()[:3000],
        "archive.npz": npz(time=TIME, u=U),
        "array.npy": npy(U),
        "sound.wav": wav(),
        "level5.mat": mat(),
        "structure.mat": mat(run={"t": TIME, "u": U, "name": "a"}),
        "tree.h5": hdf5(),
    }
    descriptions = {
        "own.toml": b'[oscillator]\nequation = "x\'\' + 2*mu*x\' + x + x**3/3 = 0"\ninitial = [1.2, 0]\nabout = "0"\n'
        b'title = "T"\npotential = "x**2/2 + x**4/12"\n[oscillator.parameters]\nmu = "1/50"\n',
    }
    return {
        **{name: (data, as_recording) for name, data in recordings.items() if data},
        **{name: (data, as_oscillator) for name, data in descriptions.items()},
        **checkpoints(folder),
    }


def child(seed: int, seconds: float, folder: Path) -> None:
    """Damage and read until the time is over; the file being read is there when this process dies."""
    from ridgeback.common.errors import InputError

    warnings.simplefilter("ignore")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    rng, counts, end = Rng(seed), Counter[str](), time.monotonic() + seconds
    whole = seeds(folder)
    for name, (data, reader) in whole.items():
        (folder / name).write_bytes(data)
        reader(folder / name)  # whole, it is read
    while time.monotonic() < end:
        name = rng.choice(tuple(whole))
        data, reader = whole[name]
        path = folder / f"damaged-{name}"
        path.write_bytes(resigned(data, rng) if name.endswith(".state") and rng.random() < 0.8 else damaged(data, rng))
        faulthandler.dump_traceback_later(LONGEST, exit=True)
        try:
            reader(path)
            counts[f"{name} read"] += 1
        except (InputError, OSError) as error:
            counts[f"{name} refused"] += 1
            if not str(error).isprintable():
                raise AssertionError(f"message {str(error)!r} is not one printable line") from error
        faulthandler.cancel_dump_traceback_later()
        path.unlink(missing_ok=True)
    print(json.dumps(counts))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run two children with seeds of their own, and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    if given.child:
        child(given.seed, given.seconds, given.child)
        return 0
    total, code = Counter[str](), 0
    folders = [Path(tempfile.mkdtemp(prefix="ridgeback-fuzz-")) for _ in range(2)]
    command = [sys.executable, "-m", "tests.fuzz.fuzz_readers", "--seconds", str(given.seconds)]
    running = [
        subprocess.Popen(
            [*command, "--child", str(folder), "--seed", str(2 * given.seed + i)], stdout=subprocess.PIPE, text=True
        )
        for i, folder in enumerate(folders)
    ]
    for process, folder in zip(running, folders, strict=True):
        out, _ = process.communicate()
        if process.returncode:
            died = f"signal {signal.Signals(-process.returncode).name}" if process.returncode < 0 else "an error"
            print(f"{died}; the input is {', '.join(map(str, folder.glob('damaged-*')))}", file=sys.stderr)
            code = 1
            continue
        total.update(json.loads(out))
        for path in folder.iterdir():
            path.unlink()
        with suppress(OSError):
            folder.rmdir()
    for name in sorted({key.rpartition(" ")[0] for key in total}):
        print(f"{name:16} {total[f'{name} refused']:6} refused {total[f'{name} read']:6} read")
    print(f"{sum(total.values())} damaged files, seed {given.seed}: {'see above' if code else 'no fault'}")
    return code


if __name__ == "__main__":
    sys.exit(main())
