"""Ridgeback beside other packages on two tasks, measured in one run; prints the table of ``docs/results/peers.md``.

    python -m benchmarks.peers.tasks --peers PYTHON

PYTHON is an interpreter with ``pip install oscilate ssqueezepy tftb sympy scipy``, which need an older NumPy than
Ridgeback does; what it does not have is left out.  Derivations are of u'' + u + eps u^3 = 0 to eps^n, and all must find
the same coefficients.  Errors are relative rms errors of omega(t) on the paper's damped pendulum, 2 to 18 s; each
estimator is used as its documentation does, without tuning.  Times are seconds of processor time, without imports.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import subprocess
import time
from collections.abc import Callable
from fractions import Fraction
from importlib.metadata import version
from typing import Any

import numpy as np

import ridgeback
from ridgeback.compare.noise.truth import Truth, paper_truth

ORDERS = (2, 3, 4)
SNR_DB = (20.0, 40.0)
EQUATION, SYMBOLIC = "u'' + u + eps*u**3 = 0", "u'' + w0**2*u + g*u**3 = 0"
DERIVING = {"sympy": "SymPy, Lindstedt's method written by hand", "oscilate": "oscilate, multiple scales"}
ESTIMATING = {
    "scipy": "SciPy, derivative of the phase of the analytic signal",
    "tftb": "tftb, peak of its pseudo-Wigner distribution, its frequencies halved",
    "ssqueezepy": "ssqueezepy, ridge of its synchrosqueezed CWT",
}

# Runs in the other interpreter: one task comes on standard input, its result and time go out as JSON.
PEER = r"""
import contextlib, importlib.metadata, io, json, sys, time
import numpy as np

def sympy(order):
    import sympy as sp
    from sympy.simplify.fu import TR8
    tau, A = sp.symbols("tau A")
    def run():
        w, u = [sp.Integer(1)], [A * sp.cos(tau)]
        for n in range(1, order + 1):
            squares = [sum(w[i] * w[m - i] for i in range(m + 1)) for m in range(n)]
            squares += [sum(w[i] * w[n - i] for i in range(1, n))]
            right = sum(squares[m] * u[n - m].diff(tau, 2) for m in range(1, n)) + squares[n] * u[0].diff(tau, 2)
            right += sum(u[i] * u[j] * u[n - 1 - i - j] for i in range(n) for j in range(n - i))
            right = sp.expand(TR8(sp.expand(right)))
            w.append(sp.factor(right.coeff(sp.cos(tau)) / (2 * A)))
            part = sum(right.coeff(sp.cos(k * tau)) / (k**2 - 1) * sp.cos(k * tau) for k in range(3, 2 * n + 2, 2))
            u.append(sp.expand(part - part.subs(tau, 0) * sp.cos(tau)))
        return [str(c) for c in w]
    return run

def oscilate(order):
    import sympy as sp
    from oscilate.MMS.dyn_sys import Dynamical_system
    from oscilate.MMS.mms import scale_parameters
    from oscilate.MMS.mms_oscillator import Multiple_scales_oscillator
    t, eps, w0 = (sp.symbols(name, real=True, positive=True) for name in ("t", "epsilon", "omega_0"))
    gamma = sp.symbols("gamma", real=True)
    x = sp.Function("x", real=True)(t)
    def run():
        with contextlib.redirect_stdout(io.StringIO()):
            _, scaling = scale_parameters([gamma], [1], eps)
            system = Dynamical_system(t, x, x.diff(t, 2) + w0**2 * x + gamma * x**3, w0)
            found = Multiple_scales_oscillator(system, eps, order, w0, scaling)
            found.apply_MMS()
        return [str(part.subs(w0, 1).as_coeff_Mul()[0]) for part in found.sol.fbetaO[0][2:]]
    return run

def scipy(x, rate):
    from scipy.signal import hilbert
    return lambda: (np.gradient(np.unwrap(np.angle(hilbert(x)))) * rate).tolist()

def tftb(x, rate):
    from scipy.signal import hilbert
    from tftb.processing import PseudoWignerVilleDistribution
    def run():
        plane, _, _ = PseudoWignerVilleDistribution(hilbert(x)).run()  # row k is k/(2 n) cycles per sample, not k/n
        return (np.pi * rate * np.argmax(plane, axis=0) / plane.shape[0]).tolist()
    return run

def ssqueezepy(x, rate):
    from ssqueezepy import extract_ridges, ssq_cwt
    def run():
        squeezed, _, frequencies, scales, *_ = ssq_cwt(x, fs=rate)
        ridge = extract_ridges(squeezed, frequencies, penalty=2, n_ridges=1, transform="cwt")
        return (2 * np.pi * frequencies[ridge[:, 0]]).tolist()
    return run

given = json.load(sys.stdin)
make = globals()[given["package"]]
if "order" in given:
    from sympy.core.cache import clear_cache
    make(1)()  # what is imported and set up once is not timed; what SymPy remembers is forgotten
    clear_cache()
    run = make(given["order"])
else:
    run = make(np.array(given["x"]), given["rate"])
    run()
begin = time.process_time()
value = run()
taken = time.process_time() - begin
json.dump({"value": value, "seconds": taken, "version": importlib.metadata.version(given["package"])}, sys.stdout)
"""


def peer(python: str, **task: Any) -> dict[str, Any] | None:
    """What a package of the other interpreter makes of a task; None where it is not there or fails."""
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(  # noqa: S603 - an interpreter that the user named
        [python, "-c", PEER], input=json.dumps(task), capture_output=True, text=True, env=env, check=False
    )
    if done.returncode:
        print(f"{task['package']}: {done.stderr.strip().splitlines()[-1]}")
        return None
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    """A value and the processor time that it took."""
    begin = time.process_time()
    value = call()
    return value, time.process_time() - begin


def derivations(python: str) -> list[list[str]]:
    """A row for each package: seconds to each order; all must find the same coefficients, or the times mean nothing."""
    rows = []
    ways = {"sympy": (EQUATION, {}), "oscilate": (SYMBOLIC, {"method": "multiple-scales"})}
    for name, (equation, options) in ways.items():
        ridgeback.derive(equation.replace("3", "5"), 4, **options)  # what is set up once is not timed
        ours = [timed(lambda n=n, e=equation, o=options: ridgeback.derive(e, 2 * n, **o)) for n in ORDERS]
        theirs = [peer(python, package=name, order=n) for n in ORDERS]
        last = theirs[-1]
        if last is not None:
            found = {ratio(text) for text in last["value"] if "/" in text}
            exact = {
                ratio(term["coefficient"]) for term in ours[-1][0].to_dict()["frequency"] if "/" in term["coefficient"]
            }
            if not found or not found <= exact:
                raise SystemExit(f"{name} finds {sorted(found)}, Ridgeback {sorted(exact)}")
        said = "Lindstedt's recursion" if name == "sympy" else "multiple scales, with symbols"
        rows.append([f"Ridgeback, {said}", version("ridgeback"), *(seconds(t) for _, t in ours)])
        rows.append(
            [DERIVING[name], last["version"] if last else "-", *(seconds(f["seconds"]) if f else "-" for f in theirs)]
        )
    return rows


def ratio(text: str) -> Fraction:
    """The size of the rational factor of a term.

    >>> ratio("-21*eps**2/256")
    Fraction(21, 256)
    """
    above, _, below = text.partition("/")
    return Fraction(int(re.findall(r"\d+", above)[0]), int(re.findall(r"\d+", below)[0]))


def noisy(truth: Truth, snr_db: float) -> np.ndarray:
    """The same noise for everybody."""
    return truth.x + truth.noise(snr_db) * np.random.default_rng(1).normal(size=truth.x.size)


def error(truth: Truth, time_: np.ndarray, omega: np.ndarray) -> float:
    """Relative rms error over 2 to 18 s."""
    inside = (time_ >= 2.0) & (time_ <= 18.0) & np.isfinite(omega)
    return float(np.sqrt(np.mean((omega[inside] / truth.omega_at(time_[inside]) - 1) ** 2)))


def estimates(python: str) -> list[list[str]]:
    """A row for each package: error at each level of noise, and seconds."""
    truth = paper_truth()
    ridgeback.estimate(truth.x, truth.rate)  # what is set up once is not timed
    clock = np.arange(truth.x.size) / truth.rate
    rows = []
    for label, options in (
        ("Ridgeback, its choice, with interval and bias", {}),
        ("Ridgeback, pseudo-Wigner peak", {"method": "pseudo_wigner", "bias": False}),
    ):
        found = [timed(lambda s=s, o=options: ridgeback.estimate(noisy(truth, s), truth.rate, **o)) for s in SNR_DB]
        errors = [f"{error(truth, track.time, track.omega):.1e}" for track, _ in found]
        rows.append([label, version("ridgeback"), *errors, seconds(found[0][1])])
    for name, label in ESTIMATING.items():
        them = [peer(python, package=name, x=noisy(truth, s).tolist(), rate=truth.rate) for s in SNR_DB]
        errors = [f"{error(truth, clock, np.array(f['value'])):.1e}" if f else "-" for f in them]
        rows.append(
            [label, them[0]["version"] if them[0] else "-", *errors, seconds(them[0]["seconds"]) if them[0] else "-"]
        )
    return rows


def seconds(value: float) -> str:
    """Two digits."""
    return f"{float(f'{value:.2g}'):g} s"


def table(head: list[str], rows: list[list[str]]) -> str:
    """Markdown."""
    return "\n".join(f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows))


def main() -> None:
    """Measure and print."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--peers", required=True, metavar="PYTHON")
    python = options.parse_args().peers
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}\n")
    print(
        table(["ω₀ of u″ + u + εu³ = 0, exactly", "version", *(f"to ε^{n}" for n in ORDERS)], derivations(python)), "\n"
    )
    print(
        table(
            ["ω₀(t) of the paper's case", "version", *(f"error, {s:g} dB" for s in SNR_DB), "time"], estimates(python)
        )
    )


if __name__ == "__main__":
    main()
