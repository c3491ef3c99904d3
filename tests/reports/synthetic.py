"""A report that nobody computed with care but that looks like one: for trying the page, never for results.

A damped pendulum is integrated quickly; tracks are its exact frequency with plausible errors added.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import stft
from scipy.special import ellipk

from compare.results import (
    Amplitudes,
    BudgetRow,
    Card,
    Case,
    Curve,
    DecayComparison,
    Derivation,
    Formula,
    Image,
    Provenance,
    Range,
    Reconstruction,
    RecordingComparison,
    Report,
    Score,
    Statement,
    Study,
    Timing,
)

K, MU, END, RATE = 4 * np.pi, 0.01, 20.0, 64.0
SERIES = {0: 1.0, 2: -1 / 16, 4: 1 / 3072, 6: -23 / 737280, 8: -2519 / 1321205760}


def exact(peak):
    return np.pi / (2 * ellipk(np.sin(np.asarray(peak) / 2) ** 2))


def series(peak, order):
    return sum(c * np.asarray(peak) ** n for n, c in SERIES.items() if n <= order)


def make_study(count: int = 40) -> Study:
    amplitudes = np.linspace(0.1, 3.0, count)
    orders = (2, 4, 6, 8, 12, 16, 20, 30)
    reference = exact(amplitudes)
    rows = []
    for order in orders:
        error = -1.5e-2 * (amplitudes / np.pi) ** (order + 2) * (1 + 4 / order) - 1e-15
        rows.append(series(amplitudes, order) if order <= 8 else reference * (1 + error))
    omega = np.array(rows)
    return Study(
        system="pendulum",
        title="the pendulum",
        method="lindstedt",
        variable="A",
        amplitude_definition="peak",
        amplitude_unit="rad",
        orders=orders,
        amplitudes=amplitudes,
        omega=omega,
        reference=reference,
        reference_error=np.full(count, 2e-16),
        reference_name="closed form, agm(1, cos A/2)",
        relative_error=omega / reference - 1,
        limit=float(np.pi),
        convergence_radius=float(np.pi),
        scale=1.0,
    )


def make_ranges(study: Study) -> tuple[Range, ...]:
    found = []
    for target in (1e-2, 1e-3, 1e-6):
        for i, order in enumerate(study.orders):
            bad = np.flatnonzero(np.abs(study.relative_error[i]) > target)
            last = bad[0] - 1 if bad.size else study.amplitudes.size - 1
            found.append(Range(order, target, float(study.amplitudes[last]) if last >= 0 else None))
    return tuple(found)


def _run():
    rhs = lambda t, y: [y[1], -2 * MU * y[1] - K**2 * np.sin(y[0])]  # noqa: E731
    time = np.arange(0, END + 1e-9, 1 / RATE)
    solved = solve_ivp(rhs, (0, END), [0.95 * np.pi, 0.0], t_eval=time, rtol=1e-9, atol=1e-9)
    return time, solved.y[0], solved.y[1]


def _image(name: str, time, signal) -> Image:
    f, t, z = stft(signal, fs=RATE, nperseg=192, noverlap=186, nfft=512, boundary="even")
    level = 20 * np.log10(np.abs(z) / np.abs(z).max() + 1e-12)
    return Image(name, t, 2 * np.pi * f, np.maximum(level, -80.0), -60.0, note="Hann window of 3 s.")


def _curve(name, label, kind, time, omega, **more) -> Curve:
    return Curve(name, label, kind, time, omega, more.pop("valid", np.ones(time.size, bool)), **more)


def _reference(time):
    energy = K**2 * (1 - np.cos(0.95 * np.pi))
    peak = np.linspace(0.95 * np.pi, 0.659 * np.pi, time.size) + 0 * energy
    peak = 0.95 * np.pi - (0.95 - 0.659) * np.pi * (1 - np.exp(-time / 14)) / (1 - np.exp(-END / 14))
    return peak, K * exact(peak)


def make_decay() -> DecayComparison:
    time, u, velocity = _run()
    peak, omega = _reference(time)
    border = 0.03 * (np.exp(-time / 0.5) + np.exp((time - END) / 0.5))
    ripple = 0.015 * np.exp(-time / 4) * np.cos(2 * np.cumsum(omega) / RATE)
    rng = np.random.default_rng(1)
    fine = 3e-4 * rng.standard_normal(time.size)
    curves = (
        _curve("closed-form", "paper (14), closed form", "model", time, omega * (1 + ripple)),
        _curve("series-5", "paper (14), 5 terms", "model", time, omega * (1 + ripple + 0.06 * np.exp(-time / 3))),
        _curve("averaged-action", "averaged action", "model", time, omega * (1 + 5e-4 * np.exp(-time / 3))),
        _curve("order-4", "expansion, order 4", "expansion", time, K * series(peak, 4)),
        _curve("order-20", "expansion, order 20", "expansion", time, omega * (1 + 2e-2 * (peak / np.pi) ** 22)),
        _curve("wigner-u", "Wigner peak of θ", "estimate", time, omega * (0.99 - border)),
        _curve("wigner-velocity", "Wigner peak of θ′", "estimate", time, omega * (0.991 + border)),
        _curve("pseudo-wigner-u", "pseudo-Wigner, 3 s", "estimate", time, omega * (1 + fine + 1e-3 - border)),
        _curve("spw-velocity", "smoothed pseudo-Wigner of θ′", "estimate", time, omega * (1.002 + 2 * border)),
    )
    reference = _curve("cycle", "cycle frequency from zero crossings", "reference", time, omega)
    turning = np.flatnonzero(np.diff(np.sign(velocity)) != 0)
    wigner = _image("Wigner distribution of θ", time, u)
    return DecayComparison(
        case=Case(
            "damped-pendulum", "the damped pendulum", "u'' + 2*mu*u' + k**2*sin(u) = 0",
            r"\ddot{\theta} + 2\mu\dot{\theta} + k^2 \sin\theta = 0", r"\theta", "rad", "s", "Galleani and Cohen, eq. (1)",
            {"k": K, "mu": MU}, (0.95 * np.pi, 0.0), END, RATE,
        ),
        time=time, u=u, velocity=velocity,
        integrators=("DOP853, rtol 1e-12", "Taylor, 30 digits"), disagreement=3.1e-11,
        amplitudes=Amplitudes(time, peak * (1 + ripple / 3), peak, time[turning], u[turning], "It ripples twice per cycle."),
        reference=reference, interior=(2.0, 18.0), curves=curves,
        scores=(
            *(
                Score(c.name, c.label, c.kind, 9.5e-3 / (i + 1) ** 2, 2e-2 / (i + 1), -9e-3 / (i + 1) ** 2, 0.03, 2e-3)
                for i, c in enumerate(curves)
            ),
            Score("hilbert", "Hilbert phase", "estimate", None, None, None, None, None, failed="the signal is too short for it"),
        ),
        budget=(
            BudgetRow("closed-form", "paper (14), closed form", 0.0, 1.9e-3, None, 1e-6, 1.9e-3, 1e-5, "The ripple of (21)."),
            BudgetRow("series-5", "paper (14), 5 terms", 2.1e-2, 1.9e-3, None, 1e-6, 2.2e-2, 1e-5),
            BudgetRow("wigner-u", "Wigner peak of θ", None, None, 9.4e-3, 1e-6, 9.5e-3, 2e-4, "Curvature of omega0(t)."),
            BudgetRow("order-4", "expansion, order 4", 4.1e-2, 3e-4, None, 1e-6, 4.2e-2, 1e-4),
        ),
        reconstruction=Reconstruction(time, u, peak * np.cos(np.cumsum(omega) / RATE), u * 0.99, 4, 0.12, 0.01, "Phase by (23)."),
        spectrogram_u=_image("Spectrogram of θ", time, u),
        spectrogram_velocity=_image("Spectrogram of θ′", time, velocity),
        wigner_u=replace(wigner, overlays=(reference,)),
        harmonics=(
            _curve("prediction-3", "3 × ω₀", "model", time, 3 * omega),
            _curve("harmonic-3", "third harmonic, phase-locked", "estimate", time, 3 * omega * (1 + fine)),
            _curve("raw-3", "raw Wigner peak near 3 ω₀", "estimate", time, 3 * omega * (1 + 0.05 * np.sin(9 * time) * np.exp(-time / 8))),
        ),
        statements=tuple(
            Statement(n, title, "What the paper says of it, paraphrased in one sentence.", "What was measured: 0.95 % rms.", names)
            for n, title, names in (
                (1, "The oscillation", ()), (2, "Spectrogram of θ", ()), (3, "Spectrogram of θ′", ()),
                (4, "Amplitude by the energy", ()), (5, "Frequency, predicted and estimated", ("wigner-u", "closed-form", "order-4")),
                (6, "The simple model", ()), (7, "Wigner of θ and θ′", ("wigner-u", "wigner-velocity")),
                (8, "Wigner and smoothed pseudo-Wigner", ("wigner-u", "spw-velocity")),
                (9, "The third harmonic", ("prediction-3", "harmonic-3", "raw-3")),
            )
        ),
    )


def make_derivation() -> Derivation:
    terms = ("1", r"-\frac{1}{16} A^{2}", r"+\frac{1}{3072} A^{4}", r"-\frac{23}{737280} A^{6}", r"-\frac{2519}{1321205760} A^{8}")
    return Derivation(
        "pendulum",
        (
            Formula("Fundamental frequency, order 8, peak amplitude", r"\frac{\omega_0}{k}", terms, "Lindstedt-Poincaré, exact.", "1 - A**2/16"),
            Formula("Slow flow", r"\frac{a'}{a}", (r"-\mu", r"-\frac{1}{16}\mu a^{2}"), "Multiple scales; weight of μ is 2."),
        ),
        ("The residual vanishes identically through order 8.", "Equal to the energy-integral series, all 5 coefficients."),
        {"Python": "def omega0(A):\n    return 1.0 - 0.0625 * A * A\n", "C": "double omega0(double A)\n{\n    return 1.0 - 0.0625 * A * A;\n}\n"},
    )


def make_recording() -> RecordingComparison:
    time = np.arange(0, 60, 0.033)
    amplitude = 4.7 * np.exp(-time / 22)
    omega = 2 * np.pi * (1.26 - 0.0036 * amplitude**2)
    signal = amplitude * np.cos(np.cumsum(omega) * 0.033)
    f, t, z = stft(signal, fs=1 / 0.033, nperseg=256, noverlap=236, nfft=1024, boundary="even")
    level = 20 * np.log10(np.abs(z) / np.abs(z).max() + 1e-9)
    ridge = _curve("pseudo-wigner", "pseudo-Wigner, 8 s", "estimate", time, omega)
    sd = np.full(time.size, 0.02) / np.maximum(amplitude, 0.3)
    return RecordingComparison(
        "decay.csv", "ab" * 32, "displacement_percent", 1 / 0.033, time, signal,
        (ridge, _curve("spectrogram", "spectrogram", "estimate", time, omega * 0.997)), "pseudo-wigner",
        Image("Spectrogram", t, 2 * np.pi * f, np.maximum(level, -80), -60.0, (ridge,), "Hann window of 8.4 s."),
        time, amplitude, amplitude, omega, sd, amplitude, np.full(time.size, 1 / 22), sd / 10,
        Formula("Fitted backbone", r"\omega_0", ("7.917", r"-0.0226\, a^{2}")), ("The longest window whose bias stays below its noise was taken.",),
    )


def provenance() -> Provenance:
    return Provenance("ridgeback report", {"ridgeback": "0.1.0", "numpy": "2.4.6"}, {"orders": "2 to 30"}, "0123abcd", "", {"study": 1.25})


def empty_report() -> Report:
    return Report("Nothing was run", "An empty report.", (), (), None, None, (), None, None, (), provenance())


def full_report() -> Report:
    study = make_study()
    ranges = make_ranges(study)
    finding = next(r for r in ranges if r.order == 6 and r.target == 1e-3)
    return Report(
        f"Order 6 stays within 0.1 % up to A = {finding.up_to:.2f} rad",
        "The damped pendulum of Galleani and Cohen: perturbation expansions, the paper's series model and "
        "Wigner-estimated frequencies over one decay from 0.95 π.",
        ("The Wigner peak lies 0.95 % low over 2 to 18 s; its cause is the curvature of omega0(t).", "Equation (21) ripples twice per cycle: 1.5 % before 1 s."),
        (
            Card("Range of use", "A ≤ 2.0 rad", "Order 6 within 0.1 % of the exact frequency."),
            Card("Worst error", "2.1 % at A = 3.0", "Order 6 at the largest amplitude studied."),
            Card("Cost", "6 ns per value", "Generated code; the closed form takes 45 ns."),
        ),
        make_derivation(), study, ranges, make_decay(), None,
        (Timing("generated, order 6", 6.1, 5.9, 7.2, 100000), Timing("closed form, agm", 45.0, 44, 51, 100000, "numpy, 6 iterations")),
        provenance(),
        {"study.csv": "order,amplitude\n" + "\n".join(f"{r['order']},{r['amplitude']}" for r in study.rows()) + "\n"},
        finding,
    )


def recording_report() -> Report:
    base = empty_report()
    return replace(base, title="The recording softens: 1.18 Hz at amplitude 4.7, 1.26 Hz at 0.3", lead="A free decay.", recording=make_recording())
