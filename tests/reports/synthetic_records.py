"""A made-up recording, what it is identified as, and a study of noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.signal import stft

from ridgeback.compare.identification.candidates import DampingLaw
from ridgeback.compare.identification.results import Candidate, Identification, MeasuredBackbone, Parameter, Prediction
from ridgeback.compare.identification.sample_fit import SampleFit, sample_fit
from ridgeback.compare.motion.results import (
    Image,
)
from ridgeback.compare.noise.results import NoiseCell, NoiseStudy
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.study.results import (
    Formula,
)
from tests.reports.synthetic_motion import curve


def make_recording() -> RecordingComparison:
    time = np.arange(0, 60, 0.033)
    amplitude = 4.7 * np.exp(-time / 22)
    omega = 2 * np.pi * (1.26 - 0.0036 * amplitude**2)
    signal = amplitude * np.cos(np.cumsum(omega) * 0.033)
    f, t, z = stft(signal, fs=1 / 0.033, nperseg=256, noverlap=236, nfft=1024, boundary="even")
    level = 20 * np.log10(np.abs(z) / np.abs(z).max() + 1e-9)
    ridge = curve("pseudo-wigner", "pseudo-Wigner, 8 s", "estimate", time, omega)
    other = curve("spectrogram", "spectrogram", "estimate", time, omega * 0.997)
    sd = np.full(time.size, 0.02) / np.maximum(amplitude, 0.3)
    return RecordingComparison(
        source="decay.csv",
        sha256="ab" * 32,
        column="displacement_percent",
        rate=1 / 0.033,
        time=time,
        signal=signal,
        curves=(ridge, other),
        chosen="pseudo-wigner",
        spectrogram=Image(
            "Spectrogram", t, 2 * np.pi * f, np.maximum(level, -80), -60.0, (ridge,), "Hann window of 8.4 s."
        ),
        amplitude_time=time,
        amplitude=amplitude,
        backbone_amplitude=amplitude,
        backbone_omega=omega,
        backbone_omega_sd=sd,
        growth_rate=np.full(time.size, 1 / 22),
        growth_rate_sd=sd / 10,
        fit=Formula("Fitted backbone", r"\omega_0", ("7.917", r"-0.0226\, a^{2}")),
        notes=("The longest window whose bias stays below its noise was taken.",),
    )


def make_noise() -> NoiseStudy:
    snr = (0.0, 10.0, 20.0, 30.0, 40.0)
    bound = [2e-2 * 10 ** (-ratio / 20) for ratio in snr]
    floors = {"harmonic-least-squares": 2e-5, "pseudo-wigner": 4.8e-4, "spectrogram": 4e-3, "hilbert": 1e-2}
    cells = []
    for method, floor in floors.items():
        for ratio, least in zip(snr, bound, strict=True):
            rms = float(np.hypot(1.05 * least, floor))
            cells.append(
                NoiseCell(
                    method, ratio, 12, rms, 0.04 * rms, -floor, 0.1 * floor, least, rms / least, 0.05, 0.95, 0.01, 0, 0
                )
            )
    refused = NoiseCell("wigner", 0.0, 12, *(None,) * 9, outliers=0, failures=12, reason="the record is too short")
    others = tuple(replace(refused, snr_db=ratio) for ratio in snr)
    return NoiseStudy(
        title="the damped pendulum",
        truth="cycle frequency of the integrated solution",
        bound="local harmonic model",
        methods=(*floors, "wigner"),
        snr_db=snr,
        trials=12,
        seed=1,
        rate=32.0,
        samples=641,
        interior=(2.0, 18.0),
        cells=(*cells, *others),
        notes=("The truth is known here.",),
    )


def _candidate(name: str, title: str, delta: float, cubic: float) -> Candidate:
    a = np.linspace(0.3, 4.7, 30)
    omega = 2 * np.pi * (1.25 - cubic * a**2)
    growth_rate = -0.06 - 0.003 * a
    return Candidate(
        name=name,
        title=title,
        equation="u'' + 2*mu*u' + k**2*u + c3*u**3 = 0",
        damping_law=DampingLaw.QUADRATIC,
        parameters=(Parameter("k", 7.85, 0.002, "rad/s", "natural frequency"), Parameter("c3", -0.3, 0.01)),
        criterion=100.0 + delta,
        delta=delta,
        weight=0.9 if delta == 0 else 0.1,
        residual=0.04,
        amplitude=a,
        omega=omega,
        omega_low=omega * 0.998,
        omega_high=omega * 1.002,
        growth_rate=growth_rate,
        growth_rate_low=growth_rate - 0.004,
        growth_rate_high=growth_rate + 0.004,
    )


def make_identification() -> Identification:
    best = _candidate("duffing-softening", "Duffing, softening", 0.0, 0.0033)
    other = _candidate("pendulum", "pendulum-like", 4.4, 0.003)
    a, time = best.amplitude[::3], np.linspace(20.0, 60.0, 50)
    predicted = 4.7 * np.exp(-time / 22)
    prediction = Prediction(
        candidate="duffing-softening",
        cycles=24.0,
        until=20.0,
        time=time,
        amplitude=predicted,
        amplitude_low=0.95 * predicted,
        amplitude_high=1.05 * predicted,
        measured_amplitude=1.02 * predicted,
        measured_amplitude_sd=0.01 * predicted,
        omega=np.full(50, 7.8),
        omega_low=np.full(50, 7.79),
        omega_high=np.full(50, 7.81),
        measured_omega=np.full(50, 7.803),
        measured_omega_sd=np.full(50, 0.004),
        phase_error=0.003 * (time - 20),
        phase_band=0.01 * (time - 20),
        measured_phase_sd=np.full(50, 0.01),
        coverage={"amplitude": 1.0, "omega": 1.0, "phase": 1.0},
        errors={"amplitude": 0.02, "omega": 4e-4, "phase": 0.07},
    )
    return Identification(
        source="decay.csv",
        column="displacement_percent",
        unit="%",
        rate=1 / 0.033,
        samples=1818,
        effective_samples=420.0,
        criterion_name="bic",
        candidates=(best, other),
        data=MeasuredBackbone(a, best.omega[::3] * 1.0005, a * 0 + 0.01, best.growth_rate[::3] + 0.001, a * 0 + 0.002),
        unexplained=0.02,
        indistinguishable=("duffing-softening", "pendulum"),
        notes=("Independent samples are counted from the residual's correlation.",),
        failed=("bilinear: no switch in reach",),
        prediction=prediction,
        fitted=fitted(),
    )


def fitted() -> SampleFit:
    t = np.arange(480) / 32.0
    model = np.exp(-0.05 * t) * np.cos(7.85 * t)
    samples = model + 0.01 * np.cos(15.7 * t) + 0.002 * np.random.default_rng(2).normal(size=t.size)
    return sample_fit(t, samples, model, 32.0, 7.85)
