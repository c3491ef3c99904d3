"""A made-up motion and what is said of it: a damped pendulum, whose tracks are its frequency with plausible errors."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import stft
from scipy.special import ellipk

from ridgeback.compare.benchmark.contenders import Crossings, Reference, Row
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.motion.harmonics.folding import folding
from ridgeback.compare.motion.results import (
    Amplitudes,
    BudgetRow,
    Case,
    Curve,
    Image,
    Integrator,
    Kind,
    MotionComparison,
    Reconstruction,
    Score,
    SignedPlane,
    Statement,
)
from ridgeback.compare.report.error_grid import ErrorGrid
from ridgeback.compare.study.results import (
    Certified,
    CertifiedRow,
    Checked,
    Derivation,
    Formula,
    HarmonicRow,
    HarmonicTable,
    Range,
    Study,
)

Array = NDArray[np.float64]

K, MU, END, RATE = 4 * np.pi, 0.01, 20.0, 64.0
SERIES = {0: 1.0, 2: -1 / 16, 4: 1 / 3072, 6: -23 / 737280, 8: -2519 / 1321205760}
FAILURE = "the signal is too short for it"


def exact(peak: Array) -> Array:
    return np.asarray(np.pi / (2 * ellipk(np.sin(peak / 2) ** 2)))


def series(peak: Array, order: int) -> Array:
    return np.sum([c * peak**n for n, c in SERIES.items() if n <= order], axis=0)


def make_study(count: int = 40, orders: tuple[int, ...] = (2, 4, 6, 8, 12, 16, 20, 30)) -> Study:
    amplitudes = np.linspace(0.1, 3.0, count)
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


def make_certified() -> Certified:
    rows = (CertifiedRow("series", (1e-9, 2.1e-3), 1e-30), CertifiedRow("Padé [4/4]", (1e-11, None), 1e-30))
    return Certified(8, np.array([1.0, 2.9]), rows)


def _run() -> tuple[Array, Array, Array]:
    time = np.arange(0, END + 1e-9, 1 / RATE)
    solved = solve_ivp(
        lambda _, y: [y[1], -2 * MU * y[1] - K**2 * np.sin(y[0])],
        (0, END),
        [0.95 * np.pi, 0.0],
        t_eval=time,
        rtol=1e-9,
        atol=1e-9,
    )
    return time, solved.y[0], solved.y[1]


def _image(name: str, signal: Array) -> Image:
    f, t, z = stft(signal, fs=RATE, nperseg=192, noverlap=168, nfft=512, boundary="even")
    level = 20 * np.log10(np.abs(z) / np.abs(z).max() + 1e-12)
    return Image(name, t, 2 * np.pi * f, np.maximum(level, -80.0), -60.0, note="Hann window of 3 s.")


def _signed(name: str, signal: Array, overlays: tuple[Curve, ...]) -> SignedPlane:
    image = _image(name, signal)
    share = 10 ** (image.level_db / 10) * np.sign(np.sin(np.arange(image.time.size)))[None, :]
    return SignedPlane(
        name, image.time, image.omega, np.arcsinh(share / 0.035) / np.arcsinh(1 / 0.035), 0.035, overlays
    )


def curve(name: str, label: str, kind: Kind, time: Array, omega: Array, **more: Any) -> Curve:
    return Curve(name, label, kind, time, omega, more.pop("valid", np.ones(time.size, bool)), **more)


def _peak(time: Array) -> Array:
    """Peak amplitude from 0.95 pi to 0.659 pi."""
    return 0.95 * np.pi - (0.95 - 0.659) * np.pi * (1 - np.exp(-time / 14)) / (1 - np.exp(-END / 14))


def _ripple(time: Array, omega: Array) -> Array:
    return 0.015 * np.exp(-time / 4) * np.cos(2 * np.cumsum(omega) / RATE)


def _fine(time: Array) -> Array:
    return 3e-4 * np.random.default_rng(1).standard_normal(time.size)


def _tracks(time: Array, peak: Array, omega: Array) -> tuple[Curve, ...]:
    border = 0.03 * (np.exp(-time / 0.5) + np.exp((time - END) / 0.5))
    ripple = _ripple(time, omega)
    return (
        curve("closed-form", "paper’s series, all terms", "model", time, omega * (1 + ripple)),
        curve("series-5", "paper’s series, 5 terms", "model", time, omega * (1 + ripple + 0.06 * np.exp(-time / 3))),
        curve("averaged-action", "averaged action", "model", time, omega * (1 + 5e-4 * np.exp(-time / 3))),
        curve("order-4", "expansion, order 4", "expansion", time, K * series(peak, 4)),
        curve("order-20", "expansion, order 20", "expansion", time, omega * (1 + 2e-2 * (peak / np.pi) ** 22)),
        curve("wigner-u", "Wigner peak of θ", "estimate", time, omega * (0.99 - border)),
        curve("wigner-velocity", "Wigner peak of θ′", "estimate", time, omega * (0.991 + border)),
        curve("pseudo-wigner-u", "pseudo-Wigner, 3 s", "estimate", time, omega * (1 + _fine(time) + 1e-3 - border)),
        curve("spw-velocity", "smoothed pseudo-Wigner of θ′", "estimate", time, omega * (1.002 + 2 * border)),
    )


def _harmonics(time: Array, omega: Array) -> tuple[Curve, ...]:
    wander = 1 + 0.05 * np.sin(9 * time) * np.exp(-time / 8)
    return (
        curve("prediction-3", "3 × ω₀", "model", time, 3 * omega),
        curve("harmonic-3", "third harmonic, phase-locked", "estimate", time, 3 * omega * (1 + _fine(time))),
        curve("raw-3", "raw Wigner peak near 3 ω₀", "estimate", time, 3 * omega * wander),
    )


def _scores(curves: tuple[Curve, ...]) -> tuple[Score, ...]:
    return (
        *(
            Score(c.name, c.label, c.kind, 9.5e-3 / (i + 1) ** 2, 2e-2 / (i + 1), -9e-3 / (i + 1) ** 2, 0.03, 2e-3)
            for i, c in enumerate(curves)
        ),
        Score("hilbert", "Hilbert phase", "estimate", None, None, None, None, None, failed=FAILURE),
    )


def budget() -> tuple[BudgetRow, ...]:
    ripple, curvature = "The ripple of (21).", "Curvature of omega0(t)."
    return (
        BudgetRow("closed-form", "paper’s series, all terms", 0.0, 1.9e-3, None, 1e-6, 1.9e-3, 1e-5, ripple),
        BudgetRow("series-5", "paper’s series, 5 terms", 2.1e-2, 1.9e-3, None, 1e-6, 2.2e-2, 1e-5),
        BudgetRow("wigner-u", "Wigner peak of θ", None, None, 9.4e-3, 1e-6, 9.5e-3, 2e-4, curvature),
        BudgetRow("order-4", "expansion, order 4", 4.1e-2, 3e-4, None, 1e-6, 4.2e-2, 1e-4),
    )


def _statements(curves: tuple[Curve, ...]) -> tuple[Statement, ...]:
    said, found = "What the paper says of it, paraphrased in one sentence.", "What was measured: 0.95 % rms."
    figures: tuple[tuple[int, str, tuple[str, ...]], ...] = (
        (1, "The oscillation", ()),
        (2, "Spectrogram of θ", ()),
        (3, "Spectrogram of θ′", ()),
        (4, "Amplitude by the energy", ()),
        (5, "Frequency, predicted and estimated", ("wigner-u", "closed-form", "order-4")),
        (6, "The simple model", ()),
        (7, "Wigner of θ and θ′", ("wigner-u", "wigner-velocity")),
        (8, "Wigner and smoothed pseudo-Wigner", ("wigner-u", "spw-velocity")),
        (9, "The third harmonic", ("prediction-3", "harmonic-3", "raw-3")),
    )
    named = {curve.name: curve for curve in curves}
    return tuple(Statement(n, title, said, found, tuple(named[k] for k in names)) for n, title, names in figures)


def make_case() -> Case:
    return Case(
        system="damped-pendulum",
        title="the damped pendulum",
        equation="u'' + 2*mu*u' + k**2*sin(u) = 0",
        equation_latex=r"\ddot{\theta} + 2\mu\dot{\theta} + k^2 \sin\theta = 0",
        symbol="θ",
        unit="rad",
        time_unit="s",
        reference="Galleani and Cohen, eq. (1)",
        parameters={"k": K, "mu": MU},
        initial=(0.95 * np.pi, 0.0),
        duration=END,
        rate=RATE,
    )


def make_decay() -> MotionComparison:
    time, u, velocity = _run()
    peak = _peak(time)
    omega = K * exact(peak)
    reference = curve("cycle", "cycle frequency from zero crossings", "reference", time, omega)
    curves, harmonics = _tracks(time, peak, omega), _harmonics(time, omega)
    turning = np.flatnonzero(np.diff(np.sign(velocity)) != 0)
    energy = peak * (1 + _ripple(time, omega) / 3)
    single = peak * np.cos(np.cumsum(omega) / RATE)
    return MotionComparison(
        case=make_case(),
        time=time,
        u=u,
        velocity=velocity,
        integrators=(Integrator("DOP853", 1e-12, 5000), Integrator("Taylor, 30 digits", difference=3.1e-11)),
        amplitudes=Amplitudes(time, energy, peak, time[turning], u[turning], "It ripples twice per cycle."),
        reference=reference,
        frequency_ends=(float(omega[0]), float(omega[-1])),
        interior=(2.0, 18.0),
        curves=curves,
        scores=_scores(curves),
        budget=budget(),
        reconstruction=Reconstruction(time, u, single, u * 0.99, 4, 0.12, 0.01, "Phase by (23)."),
        spectrogram_u=_image("Spectrogram of θ", u),
        spectrogram_velocity=_image("Spectrogram of θ′", velocity),
        wigner_u=_signed("Wigner distribution of θ", u, (reference, curves[-1])),
        harmonics=harmonics,
        statements=_statements((*curves, *harmonics)),
        folding=folding((3, 5), 1.5, 64.0),
    )


def make_derivation() -> Derivation:
    terms = ("1", r"-\frac{1}{16} A^{2}", r"+\frac{1}{3072} A^{4}", r"-\frac{23}{737280} A^{6}")
    slow = (r"-\mu", r"-\frac{1}{16}\mu a^{2}")
    return Derivation(
        system="pendulum",
        formulas=(
            Formula("Fundamental frequency", r"\frac{\omega_0}{k}", terms, "Lindstedt-Poincaré.", "1 - A**2/16"),
            Formula("Slow flow", r"\frac{a'}{a}", slow, "Multiple scales; weight of μ is 2."),
        ),
        certificate=(
            Checked("residual", "it vanishes identically through order 8", True),
            Checked("energy integral", "equal to the series", True),
        ),
        code={
            "Python": "def omega0(A):\n    return 1.0 - 0.0625 * A * A\n",
            "C": "double omega0(double A)\n{\n    return A < 1.0 && A > 0.0 ? 1.0 - 0.0625 * A * A : 1.0;\n}\n",
        },
        harmonics=HarmonicTable(
            "A", (1, 3), (HarmonicRow(1, "cos", ("1", r"\frac{1}{192}")), HarmonicRow(3, "cos", ("", "-1")))
        ),
        order=8,
    )


def make_benchmark(decay: MotionComparison) -> Benchmark:
    """Expansions by order, a series by terms, estimates raw and corrected, and one that was refused."""
    time, reference = decay.time, decay.reference.omega
    made: list[tuple[Row, Array]] = []

    def add(row: Row, size: float, **more: Any) -> None:
        error = size * (0.2 + np.exp(-time / 5)) * np.sign(np.sin(1 + time))
        made.append(
            (replace(row, relative_rms_error=size, largest=2 * size, mean=-0.1 * size, ranked=True, **more), error)
        )

    for order in (2, 4, 8, 20, 40):
        size = 0.03 * 0.87**order
        for language, cost in (("c", 1.0), ("python", 4.0)):
            name = f"lindstedt-{order}-action" + "-c" * (language == "c")
            row = Row(
                name, f"expansion, order {order}", "expansion", order=order, amplitude_from="action", language=language
            )
            add(row, size, time_ns_per_value=cost * (1 + order / 20), time_scatter=0.03, coverage=1.0)
        row = Row(f"lindstedt-{order}-energy", "", "expansion", order=order, amplitude_from="energy", language="python")
        add(row, float(np.hypot(size, 1.9e-3)), time_ns_per_value=4.0, coverage=1.0)
    for terms in (3, 21):
        row = Row(f"series-{terms}-action", "", "series-model", order=terms, amplitude_from="action", language="numpy")
        add(row, 0.6 / terms, time_ns_per_value=10.0 + terms, coverage=1.0)
    add(Row("closed-form", "exact omega0", "closed-form", amplitude_from="energy"), 1.9e-3, time_ns_per_value=900.0)
    add(Row("averaged-action", "", "averaged", amplitude_from="action"), 1.3e-4)
    for method, size in (("wigner", 9.4e-3), ("pseudo-wigner", 4.6e-4), ("harmonic-least-squares", 1.2e-5)):
        add(
            Row(method, method, "estimate"),
            size,
            time_s_per_track=0.3,
            time_ns_per_value=2.5e5,
            time_scatter=0.2,
            coverage=1.0,
        )
    corrected = Row("wigner-corrected", "", "estimate", corrected_by="its own track")
    add(corrected, 1.8e-3, time_s_per_track=0.9, time_ns_per_value=7e5, coverage=1.0)
    made.append((Row("hilbert", "Hilbert phase", "estimate", refused=FAILURE), np.full(time.size, np.nan)))
    rows = tuple(row for row, _ in made)
    reference_of = Reference("cycle frequency of the integrated solution", 1e-9, 1.8e-4)
    return Benchmark(
        case=decay.case,
        reference=reference_of,
        support=(2.0, 18.0),
        contenders=rows,
        crossings=Crossings(),
        verdict=judge(rows, reference_of),
        time=time,
        amplitude=_peak(time),
        errors=np.array([np.where(np.isfinite(reference), error, np.nan) for _, error in made]),
    )


def make_grid(study: Study) -> ErrorGrid:
    """The grid of the sliders: the study's own numbers, called certified, with code that is one of them."""
    function = "function omega0(A, k = 1.0) {\n  return k*(1.0 - 0.0625*A*A);\n}"
    powers = np.array([order + 2.0 for order in study.orders])
    return ErrorGrid(
        orders=study.orders,
        amplitudes=study.amplitudes,
        exact=study.reference,
        values=study.omega,
        errors=study.relative_error,
        bounds=np.abs(study.relative_error) * 1.001,
        certified=True,
        code=dict.fromkeys(study.orders, function),
        scale=1.0,
        observed=((0.06, 0.12, powers), (0.5, 1.0, powers + 0.2)),
    )
