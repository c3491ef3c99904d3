"""An oscillator, an estimator, a language and a section of the report, added to Ridgeback from outside."""

import numpy as np

from ridgeback import Oscillator, Track
from ridgeback.reports.parts import Part, Section
from ridgeback.symbolic.codegen.languages.language import Language


def cable():
    """A cable whose sag makes its spring asymmetric."""
    return Oscillator.from_equation("u'' + u'/100 + u + u**2/4 + u**3/10 = 0", name="sagging-cable")


def teager(x, rate):
    """DESA-2 (Maragos, Kaiser and Quatieri 1993): sin^2 W = psi(x[n+1] - x[n-1]) / (4 psi(x[n])), W = omega/rate."""

    def psi(y):
        return y[1:-1] ** 2 - y[2:] * y[:-2]

    share = psi(x[2:] - x[:-2]) / (4 * psi(x)[1:-1])
    valid = (share > 0) & (share < 1)
    omega = rate * np.arcsin(np.sqrt(np.where(valid, share, np.nan)))
    return Track(np.arange(2, x.size - 2) / rate, omega, valid, "teager")


class Awk(Language):
    """Functions of awk, in the operations that a power series needs."""

    name, suffix, comment, end, modes = "awk", "awk", "#", "", ("strict",)

    def literal(self, value, form):
        return repr(float(value))

    def assign(self, name, value, *, first, form):
        return f"{name} = {value}"

    def loop(self, horner, table, *, first, form):
        numbers = " ".join(self.literal(c.nearest if c else 0.0, form) for c in reversed(horner.coefficients))
        step = f"for (i = 2; i <= n; i++) {horner.name} = {horner.name}*{horner.at} + {table}[i]"
        return [f'n = split("{numbers}", {table}, " "); {horner.name} = {table}[1]', step]

    def write(self, form):
        lines = [self.remark(line) for line in self.heading(form)]
        for f in form.functions:
            lines += [f"function {f.name}({', '.join(a.name for a in f.arguments)}) {{"]
            lines += [*self.body(f, form), f"return {self.operand(f.result, form)}", "}"]
        return "\n".join(lines) + "\n"

    def package(self, form):
        return {f"{form.name}.awk": self.write(form)}


def change(report):
    """How far the frequency goes along the motion of a report."""
    if report.decay is None:
        return None
    text = "omega0 goes from {:.6g} to {:.6g}.".format(*report.decay.frequency_ends)
    return Section("change", "Change", "How far the frequency goes", (Part("text", text),))
