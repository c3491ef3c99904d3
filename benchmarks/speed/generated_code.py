"""How fast generated code is, as ratios within one run; prints the table of docs/reference/generated-code.md.

    python -m benchmarks.speed.generated_code

Times are medians of repeats on one core; on a shared machine the ratios say more than the nanoseconds.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from math import comb
from pathlib import Path

import numpy as np
import sympy
from flint import fmpq
from numpy.polynomial import polynomial
from scipy.special import ellipk
from sympy.printing.c import C99CodePrinter

from ridgeback.compare.binding.generated_code import python_module, tool_of, write_files
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.codegen import form_of, generate, packaged, written
from ridgeback.symbolic.codegen.formulas.closed_forms import mean_form
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.systems.catalogue import find

VALUES, REPEATS, END = 4096, 31, Fraction(5, 2)

# ruff: noqa: E501
TIMER = r"""
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "clock.h"
double naive(double A, double k);
double by_hand(double A, double k);
double clock_mean(double A, double k);
static double now(void) { struct timespec t; clock_gettime(CLOCK_MONOTONIC, &t); return 1e9*t.tv_sec + t.tv_nsec; }
static int order(const void *a, const void *b) { double d = *(const double *)a - *(const double *)b; return (d > 0) - (d < 0); }
static double middle(double *t, int n) { qsort(t, n, sizeof *t, order); return t[n/2]; }
int main(void)
{
    enum { N = 4096, R = 101 };
    static double x[N], y[N], t[R];
    volatile double sink = 0;
    for (int i = 0; i < N; i++) x[i] = 2.5*(i + 1)/N;
    for (int r = 0; r < R; r++) { double s = now(); clock_omega0_array(x, y, N, 1.0); t[r] = (now() - s)/N; sink += y[r]; }
    printf("%.3f ", middle(t, R));
    for (int r = 0; r < R; r++) { double s = now(), a = 1; for (int i = 0; i < N; i++) a = clock_omega0(x[i] + a*1e-300, 1.0); t[r] = (now() - s)/N; sink += a; }
    printf("%.3f ", middle(t, R));
    for (int r = 0; r < R; r++) { double s = now(), a = 0; for (int i = 0; i < N; i++) a += clock_omega0(x[i], 1.0); t[r] = (now() - s)/N; sink += a; }
    printf("%.3f ", middle(t, R));
    for (int r = 0; r < R; r++) { double s = now(), a = 0; for (int i = 0; i < N; i++) a += naive(x[i], 1.0); t[r] = (now() - s)/N; sink += a; }
    printf("%.3f ", middle(t, R));
    for (int r = 0; r < R; r++) { double s = now(), a = 0; for (int i = 0; i < N; i++) a += by_hand(x[i], 1.0); t[r] = (now() - s)/N; sink += a; }
    printf("%.3f ", middle(t, R));
    for (int r = 0; r < R; r++) { double s = now(), a = 0; for (int i = 0; i < N; i++) a += clock_mean(x[i], 1.0); t[r] = (now() - s)/N; sink += a; }
    printf("%.3f\n", middle(t, R));
    return sink == 12345;
}
"""


def nanoseconds(function: Callable[[], object], values: int) -> float:
    """Median time per value."""
    function()
    laps = []
    for _ in range(REPEATS):
        start = time.perf_counter_ns()
        function()
        laps.append(time.perf_counter_ns() - start)
    return statistics.median(laps) / values


def in_c(series: Expansion, flags: tuple[str, ...]) -> list[float] | None:
    """Array, dependent calls, independent calls; SymPy's C, Horner's rule by hand and the agm by the last; ns a value."""
    tool = tool_of("c")
    if tool is None:
        return None
    form = form_of(series, up_to=END, name="clock")
    naive = f"double naive(double A, double k) {{ return k*({C99CodePrinter().doprint(series.expression())}); }}\n"
    mean = form_of(mean_form(find("pendulum")), up_to=END, name="agm")
    other = written(mean, "c") + "double clock_mean(double A, double k) { return agm_omega0(A, k); }\n"
    with tempfile.TemporaryDirectory() as folder:
        write_files(Path(folder), {**packaged(form, "c"), "timer.c": TIMER, "naive.c": f"#include <math.h>\n{naive}"})
        write_files(Path(folder), {"hand.c": by_hand(series), "agm.c": other})
        command = [
            tool,
            "-D_POSIX_C_SOURCE=199309L",
            "-std=c99",
            *flags,
            "timer.c",
            "clock.c",
            "naive.c",
            "hand.c",
            "agm.c",
            "-o",
            "timer",
            "-lm",
        ]
        subprocess.run(command, cwd=folder, check=True, stderr=subprocess.DEVNULL)  # noqa: S603
        done = subprocess.run([str(Path(folder) / "timer")], capture_output=True, text=True, check=True)  # noqa: S603
    return [float(word) for word in done.stdout.split()]


def by_hand(series: Expansion) -> str:
    """Horner's rule in A^2 over a table, as one writes it."""
    table = ", ".join(repr(float(c)) for c in reversed(series.frequency[::2]))
    count = series.order // 2 + 1
    return (
        f"static const double c[{count}] = {{{table}}};\n"
        f"double by_hand(double A, double k) {{ double x = A*A, y = c[0]; for (int i = 1; i < {count}; i++) "
        "y = y*x + c[i]; return k*y; }\n"
    )


def arrays(series: Expansion) -> Iterator[tuple[str, float]]:
    """Ways to omega0 over one array."""
    x: Array = np.linspace(0.001, float(END), VALUES)
    dense = np.array([float(c) for c in series.frequency])
    A = sympy.Symbol("A", real=True)
    lambdified = sympy.lambdify(A, series.expression(), "numpy")
    module = python_module(series)
    out = np.empty_like(x)
    yield "generated Python, NumPy array", nanoseconds(lambda: module.omega0(x), VALUES)
    yield "the same in place, unchecked", nanoseconds(lambda: module.omega0_array(x, out), VALUES)
    yield "numpy.polynomial, same coefficients", nanoseconds(lambda: polynomial.polyval(x, dense), VALUES)
    yield "numpy.polynomial in A^2", nanoseconds(lambda: polynomial.polyval(x * x, dense[::2]), VALUES)
    yield "SymPy lambdify", nanoseconds(lambda: lambdified(x), VALUES)
    yield "agm (exact), six steps by hand", nanoseconds(lambda: agm(x), VALUES)
    yield "Horner's rule in A^2 by hand", nanoseconds(lambda: horner(x, dense[::2]), VALUES)
    yield "scipy ellipk (exact)", nanoseconds(lambda: np.pi / 2 / ellipk(np.sin(x / 2) ** 2), VALUES)
    one = 1.3
    yield "generated Python, one float", nanoseconds(lambda: [module.omega0(one) for _ in range(64)], 64)
    yield "Expansion.__call__, one float", nanoseconds(lambda: [series(one) for _ in range(64)], 64)


def agm(amplitude: Array) -> Array:
    """The pendulum's omega0 by the arithmetic-geometric mean."""
    a, b = np.ones_like(amplitude), np.cos(amplitude / 2)
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return a


def horner(amplitude: Array, coefficients: Array) -> Array:
    """As one writes it."""
    x, y = amplitude * amplitude, np.full_like(amplitude, coefficients[-1])
    for c in coefficients[-2::-1]:
        y = y * x + c
    return y


def long_expansion() -> Expansion:
    """1000 terms with the size of a real expansion's rationals."""
    values = [fmpq(0)] * 1999
    for n in range(1000):
        values[2 * n] = fmpq((-1) ** n * comb(2 * n, n) ** 2, 256**n)
    return replace(energy_integral(find("pendulum"), 2), order=1998, coefficients=tuple(values))


def main() -> None:
    """Print every figure."""
    print(f"# Python {sys.version.split()[0]}, {VALUES} values up to A = {float(END)}, ns a value")
    for n in (10, 40, 100, 200):
        series = energy_integral(find("pendulum"), n)
        for name, flags in (("-O3", ("-O3",)), ("-O3 -march=native", ("-O3", "-march=native"))):
            found = in_c(series, flags)
            if found is not None:
                print(f"A^{n} C {name}: array {found[0]}, chain {found[1]}, call {found[2]}, ", end="")
                print(f"SymPy's ccode {found[3]}, Horner by hand {found[4]}, agm {found[5]}")
        if n == 40:
            for name, value in arrays(series):
                print(f"A^{n} {name}: {value:.2f}")
    long = long_expansion()
    start = time.process_time()
    source = generate(long, "c")
    print(f"1000 terms as C: {time.process_time() - start:.3f} s of CPU, {len(source) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
