"""Cases about the process: locale, home, terminal, pipes, full and read-only disks, names that are not text, workers.

Each is a line for bash, where ``$R`` is the command.  What a line makes, it makes in a folder of its own.
"""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping

from tests.faults.trial import Case

Variables = Mapping[str, str | None]
HILBERT = "$R estimate decay.csv --method hilbert"
IN_A_FOLDER = "d=$(mktemp -d); trap 'rm -rf \"$d\"' EXIT; "
"""A folder ``$d`` that goes when the line ends."""
NOTHING_LEFT = '; c=$?; [ -z "$(ls -A "$d")" ] || exit 99; exit $c'
"""Exit code 99 when the line left anything in ``$d``."""
C: Variables = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
COMMA: Variables = {"LC_ALL": "de_DE.UTF-8", "LC_NUMERIC": "de_DE.UTF-8"}
CALL = "import sys; from ridgeback.cli import main; raise SystemExit(main(sys.argv[1:]))"
WORKERS = "study cells.toml --workers 2 --store $d/cells.db"


def shell(line: str, code: int, *words: str, **environment: str | None) -> Case:
    """A line for bash with some variables set, or with None taken away."""
    return Case(line, code, words, by_bash=True, environment=environment)


def with_disk(options: str, line: str, code: int, *words: str) -> Case:
    """A line with a small disk of its own at ``folder.csv``, seen by nobody else."""
    return shell(
        f"unshare -m bash -c 'mount -t tmpfs -o {options} none folder.csv && d=folder.csv; {line}'", code, *words
    )


def disks_can_be_made() -> bool:
    """Whether this user may mount a small disk in a name space of its own."""
    line = ["unshare", "-m", "mount", "-t", "tmpfs", "none", "/mnt"]
    return (
        shutil.which("unshare") is not None and subprocess.run(line, capture_output=True, check=False).returncode == 0
    )


ENVIRONMENT: tuple[Case, ...] = (
    shell("$R derive pendulum --order 4", 0, "1/3072", **C),
    shell("$R derive duffing --order 4 --resummed pade", 0, "Pade", **C),
    shell("$R derive пендул", 2, "no system", **C),
    shell("$R estimate semicolon.csv --method hilbert", 0, "400 samples", **C),
    shell("$R simulate pendulum --duration 1 --rate 4 2> /dev/null", 0, "0.25,2.979", **COMMA),
    shell(f"{HILBERT} 2> /dev/null", 0, "0.00233813", **COMMA),
    shell("$R derive pendulum --order 4", 0, "0.000325521", PYTHONIOENCODING="ascii"),
    shell("$R derive duffing --order 4 --resummed pade", 0, "Pade", PYTHONIOENCODING="latin-1"),
    shell("$R derive pendulum --order 2", 0, "-1/16", HOME=None),
    shell(f"{IN_A_FOLDER}{HILBERT} --plot $d/a.svg", 0, "400 samples", HOME="/proc/nowhere"),
    shell("$R derive pendulum --order 2", 0, "-1/16", TMPDIR="/proc/nowhere"),
    shell(f"{IN_A_FOLDER}$R {WORKERS}", 0, "duffing", TMPDIR="/proc/nowhere"),
    shell("$R derive pendulum --order 2", 0, "-1/16", TERM="dumb"),
    shell("$R derive pendulum --order 2", 0, "-1/16", TERM=None),
    shell(f"{IN_A_FOLDER}{HILBERT} --plot $d/a.png", 0, "400", DISPLAY=None, WAYLAND_DISPLAY=None),
    shell(f"{IN_A_FOLDER}{HILBERT} --plot $d/a.png", 0, "400", DISPLAY=None, MPLBACKEND="TkAgg"),
    shell("$R derive --help", 0, "--order", COLUMNS="1"),
    shell("$R derive --help", 0, "--order", COLUMNS="x"),
    shell(HILBERT, 0, "400 samples", OPENBLAS_NUM_THREADS="x"),
    shell(HILBERT, 0, "400 samples", PYTHONWARNINGS="error"),
    shell("$R derive pendulum --order 4 --verify", 0, "1/3072", PYTHONOPTIMIZE="2"),
    shell("$R derive damped-pendulum --order 4", 0, "mu^2", PYTHONHASHSEED="7"),
    shell("$R derive pendulum --order 2", 0, "-1/16", RIDGEBACK_DEBUG="1"),
    shell(f"(ulimit -v 2000000; {HILBERT})", 0, "400 samples"),
    shell("(ulimit -n 32; $R derive pendulum --order 2)", 0, "-1/16"),
)

STREAMS: tuple[Case, ...] = (
    shell("$R derive pendulum <&-", 0, "-1/16"),
    shell("$R derive pendulmu 2>&-; [ $? = 2 ]", 0),
    shell("$R derive pendulmu >&- 2>&-; [ $? = 2 ]", 0),
    shell("$R systems > /dev/full", 4, "No space"),
    shell("$R simulate linear --duration 300 --rate 300 > /dev/full", 4, "No space"),
    shell("$R --help > /dev/full", 4, "No space"),
    shell("$R --version > /dev/full", 4, "No space"),
    shell("$R derive pendulum -o /dev/full", 4, "'/dev/full'", "No space"),
    shell("$R derive pendulmu 2> /dev/full; [ $? = 2 ]", 0),
    shell("$R derive pendulum -o /dev/null", 0),
    shell("$R simulate linear --duration 300 --rate 300 | head -n 1; [ ${PIPESTATUS[0]} = 141 ]", 0, "time_s,u"),
    shell("$R derive pendulum | true; [ ${PIPESTATUS[0]} = 141 ]", 0),
    shell("$R derive pendulum --format json | $PYTHON -m json.tool --compact", 0, "pendulum"),
    shell("$R estimate <(cat decay.csv)", 2, "is a pipe", "in a file first"),
    shell("$R estimate /dev/stdin < decay.csv", 2, "suffix"),
)

NAMES: tuple[Case, ...] = (
    shell(f"{IN_A_FOLDER}mkdir $d/gone && cd $d/gone && rmdir ../gone && $R derive pendulum --order 2", 0, "-1/16"),
    shell(
        f"{IN_A_FOLDER}mkdir $d/gone && cd $d/gone && rmdir ../gone && $R derive pendulum -o a.txt",
        4,
        "'a.txt'",
        "No such file",
    ),
    shell(
        rf"{IN_A_FOLDER}cp decay.csv $d/$'\xff'.csv && $R estimate $d/$'\xff'.csv --method hilbert", 0, "400 samples"
    ),
    shell(rf"{IN_A_FOLDER}cp good.toml $d/$'\xff'.toml && $R derive $d/$'\xff'.toml", 0, "3/8"),
    shell(rf"{IN_A_FOLDER}cp good.toml $d/$'\xff'.toml && $R generate $d/$'\xff'.toml --language c", 0, "omega0"),
    shell(rf"{IN_A_FOLDER}$R derive pendulum -o $d/$'\xff'.txt && ls $d | wc -l", 0, "1"),
    shell(rf"{IN_A_FOLDER}$R derive pendulum -o $d/$'a\nb'.txt && [ -s $d/$'a\nb'.txt ]", 0),
    shell(
        rf"{IN_A_FOLDER}cp empty.csv $d/$'a\nb\x1b[31m'.csv; $R estimate $d/$'a\nb\x1b[31m'.csv", 2, r"a b\x1b[31m.csv"
    ),
    shell(r"$R derive $'\x1b[31mred\x07'", 2, r"\x1b[31mred\x07"),
    shell(r"$R derive $'\u202egnp'", 2, r"\u202e"),
    shell("$R derive pendulum -o $(printf 'x%.0s' $(seq 300))", 4, "too long"),
    shell("$R estimate $(printf 'x%.0s' $(seq 300)).csv", 4, "too long"),
    shell(f"{IN_A_FOLDER}touch $d/real; ln -s real $d/l; $R derive pendulum -o $d/l; [ -L $d/l ] && [ -s $d/real ]", 0),
    shell(f"{IN_A_FOLDER}ln -s /proc/nowhere/x $d/l; $R derive pendulum -o $d/l", 4, "No such folder"),
    shell(
        f"{IN_A_FOLDER}cp decay.csv $d; cd $d; mkdir reports symbolic; "
        f"touch compare.py numeric.py reports/__init__.py symbolic/__init__.py; {HILBERT}",
        0,
        "400 samples",
    ),
)

LIMITS: tuple[Case, ...] = (
    shell(
        f"{IN_A_FOLDER}(ulimit -f 4; $R simulate pendulum --duration 2000 -o $d/run.csv){NOTHING_LEFT}",
        4,
        "run.csv'",
        "too large",
    ),
    shell("timeout --preserve-status -s INT 2 $R derive van-der-pol --order 200 --digits 30", 130, "interrupted"),
)

WORKING: tuple[Case, ...] = (
    shell(f"{IN_A_FOLDER}$R {WORKERS}", 0, "duffing"),
    shell(f"{IN_A_FOLDER}$PYTHON -c '{CALL}' {WORKERS}", 0, "duffing"),
    shell(
        f"{IN_A_FOLDER}printf 'if __name__ == \"__main__\":\\n    {CALL}\\n' > $d/run.py; $PYTHON $d/run.py {WORKERS}",
        0,
        "duffing",
    ),
)

DISKS: tuple[Case, ...] = (
    with_disk("size=16k", f"$R simulate pendulum -o $d/run.csv{NOTHING_LEFT}", 4, "'folder.csv/run.csv'", "No space"),
    with_disk("size=16k", f"{HILBERT} --plot $d/a.svg > /dev/null{NOTHING_LEFT}", 4, "No space"),
    with_disk(
        "size=16k",
        f"$R generate pendulum --order 80 --language c -o $d/p.c{NOTHING_LEFT}",
        4,
        "'folder.csv/p.c'",
        "No space",
    ),
    with_disk("ro", "$R derive pendulum -o $d/a.txt", 4, "No permission"),
    with_disk("ro", f"{HILBERT} --plot $d/a.svg", 4, "No permission"),
    with_disk("ro", "$R derive pendulum --digits 30 --checkpoint $d/state", 4, "No permission"),
    with_disk("noexec", "TMPDIR=$PWD/$d $R generate pendulum --language c --check", 4, "folder.csv/", "noexec"),
    with_disk("noexec", "TMPDIR=$PWD/$d $R generate pendulum --check -o /dev/null", 0, "python: passed"),
    with_disk("ro", "cd $d && $R derive pendulum --order 2", 0, "-1/16"),
)
CASES = (*ENVIRONMENT, *STREAMS, *NAMES, *LIMITS, *WORKING)
