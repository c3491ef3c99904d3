"""Kinds of record of which only noise and phases are drawn."""

from __future__ import annotations

import numpy as np

from benchmarks.trials.records.motions import (
    Decay,
    Kind,
    bent_mode,
    chirp,
    coloured,
    damped,
    hum,
    jumping,
    modulated,
    released,
    second_mode,
    spiked,
    struck_twice,
    triggered,
)

KINDS: dict[str, Kind] = {
    "damping ratio 0.3 %, 60 cycles": damped(0.003, 60.0),
    "damping ratio 1 %, 60 cycles": damped(0.01, 60.0),
    "damping ratio 3 %, 17 cycles": damped(0.03, 17.0),
    "damping ratio 5 %, 10 cycles": damped(0.05, 10.0),
    "damping ratio 10 %, 5 cycles": damped(0.1, 5.0),
    "damping ratio 3 %, 40 cycles: a tail": damped(0.03, 40.0),
    "damping ratio 10 %, 40 cycles: a tail": damped(0.1, 40.0),
    "damping ratio 5 %, 4 cycles": damped(0.05, 4.0),
    "damping ratio 10 %, 3.5 cycles": damped(0.1, 3.5),
    "quadratic drag": Decay(0.628, 2.0, 8.0, 0.05),
    "quadratic drag, little noise, long tail": Decay(0.628, 6.0, 8.0, 0.05, noise=0.002),
    "cubic spring with its third harmonic": Decay(0.8, 3.0, 0.0, 0.1, third=0.05, noise=0.01),
    "hum of 2 % beside the mode": Decay(0.0628, 60.0, frequency=2.0, rate=15.0, noise=0.005, spoil=hum(0.02, 2.23)),
    "hum of 20 % beside the mode": damped(0.01, 40.0, spoil=hum(0.2, 23.0)),
    "two modes 8 % apart": damped(0.004, 60.0, spoil=second_mode(0.4, 21.6, 0.004)),
    "two modes 4 % apart": damped(0.003, 80.0, spoil=second_mode(0.5, 20.8, 0.003)),
    "modes 1 : 1.99": damped(0.005, 60.0, spoil=second_mode(0.5, 39.8, 0.004)),
    "held, released, stopped": released,
    "silence before a blow": triggered,
    "clipped at 60 %": Decay(
        0.0628, 40.0, 0.0, 0.05, frequency=2.0, rate=20.0, noise=0.004, spoil=lambda x, _t, _rng: np.clip(x, -0.6, 0.6)
    ),
    "spikes": damped(0.01, 40.0, spoil=spiked),
    "1/f noise": damped(0.01, 40.0, noise=0.001, spoil=coloured(0.03)),
    "a chirp that rises to six times": chirp,
    "a swinging frequency": modulated,
    "struck twice": struck_twice,
    "a frequency that jumps": jumping(0.03, 0.33),
    "a frequency that jumps a little": jumping(0.002, 0.03),
    "two modes 2 % apart": damped(0.003, 120.0, spoil=second_mode(0.5, 20.4, 0.003)),
    "two modes, one not linear": damped(0.006, 60.0, spoil=bent_mode(0.4, 26.0, 0.006, 0.3)),
    "hum at twice the frequency": damped(0.01, 40.0, spoil=hum(0.1, 40.0)),
    "three modes": damped(
        0.006,
        40.0,
        spoil=lambda x, t, rng: second_mode(0.3, 17.0, 0.005)(second_mode(0.5, 24.0, 0.005)(x, t, rng), t, rng),
    ),
    "damping ratio 15 %, 4 cycles": damped(0.15, 4.0),
    "damping ratio 1 %, strong noise": damped(0.01, 60.0, noise=0.1),
}
