"""Studies from TOML files: unknown keys, wrong types, empty ranges, damaged and foreign stores, changed settings."""

from __future__ import annotations

from collections.abc import Mapping

from tests.faults.trial import Case, refused, unusable

HEAD = '[study]\nask = "error"\n'
GRID = "[grid]\norders = [2, 4]\namplitudes = [0.5, 1]\n"
ONE = '[[oscillator]]\nsystem = "pendulum"\n'
MOTION = '[study]\nask = "decay-error"\n[grid]\namplitudes = [1]\nmethods = ["hilbert"]\n'

BROKEN: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "unknown_table": (
        HEAD + GRID + ONE + "[signals]\nrate = 4\n",
        ("line 8, signals", "a study has no table 'signals'"),
    ),
    "unknown_key": (HEAD + GRID + "order = [2]\n" + ONE, ("line 6, grid.order: no such key", "may have amplitudes")),
    "unknown_study_key": (
        HEAD + 'colour = "red"\n' + GRID + ONE,
        ("line 3, study.colour: no such key", "may have title, ask"),
    ),
    "unknown_question": ('[study]\nask = "errors"\n' + GRID + ONE, ("line 2, study.ask", "no question 'errors'")),
    "no_question": ("[study]\n" + GRID + ONE, ("study.ask: is missing", 'ask = ["error"]')),
    "two_measures": (
        '[study]\nask = ["error", "range"]\n' + GRID + ONE,
        ("line 2, study.ask", "ask them in two studies"),
    ),
    "empty_ask": ("[study]\nask = []\n" + GRID + ONE, ("study.ask: is an empty list", "give one or more")),
    "ask_number": ("[study]\nask = 3\n" + GRID + ONE, ("study.ask: 3 is not text", "quotation marks")),
    "unknown_method": (
        HEAD + '[grid]\nmethods = ["lindsted"]\norders = [2, 4]\namplitudes = [0.5, 1]\n' + ONE,
        ("line 4, grid.methods", "no method 'lindsted'"),
    ),
    "no_oscillator": (HEAD + GRID, ("no oscillator", "write [[oscillator]]")),
    "oscillator_table": (HEAD + GRID + '[oscillator]\nsystem = "pendulum"\n', ("line 6, oscillator", "[[oscillator]]")),
    "unknown_system": (
        HEAD + GRID + '[[oscillator]]\nsystem = "pendulun"\n',
        ("line 7, oscillator.1.system", "did you mean pendulum"),
    ),
    "bad_equation": (
        HEAD + GRID + "[[oscillator]]\nequation = \"u'' + __import__('os') = 0\"\n",
        ("line 7, oscillator.1.equation", "the prime at column"),
    ),
    "both": (
        HEAD + GRID + ONE + "equation = \"u'' + u = 0\"\n",
        ("oscillator.1: both system and equation", "give one"),
    ),
    "no_system": (
        HEAD + GRID + '[[oscillator]]\nname = "x"\n',
        ("oscillator.1: neither system nor equation", "give one"),
    ),
    "bad_name": (HEAD + GRID + ONE + 'name = "a\\u001bb"\n', ("line 8, oscillator.1.name", "is no name")),
    "same_name": (HEAD + GRID + ONE + ONE, ("line 8, oscillator.2: is oscillator.1 once more", "another name")),
    "unknown_parameter": (
        HEAD + GRID + ONE + "parameters = { q = 1 }\n",
        ("oscillator.1.parameters.q", "its parameters: mu, k"),
    ),
    "parameter_text": (
        HEAD + GRID + ONE + 'parameters = { mu = "one" }\n',
        ("oscillator.1.parameters.mu: 'one' is not a number", "without quotes"),
    ),
    "parameter_twice": (
        HEAD + GRID + ONE + "parameters = { mu = [0.1, 0.1] }\n",
        ("oscillator.1.parameters.mu: holds 0.1 twice", "once"),
    ),
    "parameters_list": (
        HEAD + GRID + ONE + "parameters = [1]\n",
        ("oscillator.1.parameters: [1] is not a table", "write parameters"),
    ),
    "empty_orders": (
        HEAD + "[grid]\norders = []\namplitudes = [0.5, 1]\n" + ONE,
        ("line 4, grid.orders: is an empty list", "a range such as"),
    ),
    "negative_order": (
        HEAD + "[grid]\norders = [2, -4]\namplitudes = [0.5, 1]\n" + ONE,
        ("grid.orders: holds -4", "whole numbers from 0"),
    ),
    "order_twice": (
        HEAD + "[grid]\norders = [2, 2]\namplitudes = [0.5, 1]\n" + ONE,
        ("grid.orders: holds 2 twice", "once"),
    ),
    "broken_order": (
        HEAD + "[grid]\norders = [2.5]\namplitudes = [0.5, 1]\n" + ONE,
        ("grid.orders: holds 2.5", "whole numbers"),
    ),
    "order_text": (
        HEAD + '[grid]\norders = "two"\namplitudes = [0.5, 1]\n' + ONE,
        ("grid.orders: 'two' is not a number", "a range such as"),
    ),
    "huge_order": (
        HEAD + "[grid]\norders = [100000]\namplitudes = [0.5, 1]\n" + ONE,
        ("grid.orders: holds 100000", "to 400"),
    ),
    "empty_amplitudes": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = []\n" + ONE,
        ("line 5, grid.amplitudes: is an empty list", "a range such as"),
    ),
    "negative_amplitude": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = [-1]\n" + ONE,
        ("grid.amplitudes: holds -1", "above 0"),
    ),
    "zero_amplitude": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = [0]\n" + ONE,
        ("grid.amplitudes: holds 0", "above 0"),
    ),
    "nan_amplitude": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = [nan]\n" + ONE,
        ("grid.amplitudes: NaN is not a finite", "a range such as"),
    ),
    "inf_amplitude": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = [inf]\n" + ONE,
        ("grid.amplitudes: Infinity is not a finite", "a range such as"),
    ),
    "bool_amplitude": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = [true]\n" + ONE,
        ("grid.amplitudes: True is not a number", "a range such as"),
    ),
    "range_reversed": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = { from = 3, to = 1, count = 5 }\n" + ONE,
        ("from = 3 is not below to = 1", "swap them"),
    ),
    "range_short": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = { from = 1, to = 3 }\n" + ONE,
        ("grid.amplitudes: lacks 'count'", "a range is"),
    ),
    "range_unknown": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = { from = 1, to = 3, count = 3, step = 1 }\n" + ONE,
        ("grid.amplitudes: has 'step'", "a range is"),
    ),
    "range_count": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = { from = 1, to = 3, count = 1 }\n" + ONE,
        ("count = 1 is not a whole number", "from 2 to"),
    ),
    "range_spacing": (
        HEAD + '[grid]\norders = [2, 4]\namplitudes = { from = 1, to = 3, count = 3, spacing = "cubic" }\n' + ONE,
        ("spacing = 'cubic'", "neither"),
    ),
    "range_log": (
        HEAD + '[grid]\norders = [2, 4]\namplitudes = { from = 0, to = 3, count = 3, spacing = "log" }\n' + ONE,
        ("from = 0 has no logarithm", "above 0"),
    ),
    "many_cells": (
        HEAD + "[grid]\norders = [2, 4]\namplitudes = { from = 0.1, to = 3, count = 90000000 }\n" + ONE,
        ("count = 90000000", "from 2 to"),
    ),
    "no_amplitudes": (HEAD + "[grid]\norders = [2]\n" + ONE, ("grid.amplitudes: is missing", "for instance")),
    "not_toml": (HEAD + "[grid\n", ("is not TOML", "line 3, column 6")),
    "key_twice": (HEAD + GRID + "orders = [3]\n" + ONE, ("is not TOML", "line 6")),
    "negative_rate": (
        MOTION + "[signal]\nduration = 60\nrate = -4\n" + ONE,
        ("line 8, signal.rate: holds -4", "above 0"),
    ),
    "rate_alone": (MOTION + "[signal]\nrate = 4\n" + ONE, ("signal.rate: needs duration beside it",)),
    "rate_and_periods": (
        MOTION + "[signal]\nperiods = 20\nrate = 4\n" + ONE,
        ("signal.periods: stands beside rate", "give duration and rate"),
    ),
    "trials_broken": (MOTION + "[signal]\ntrials = 2.5\n" + ONE, ("signal.trials: '2.5' is not a whole number",)),
    "trials_one": (MOTION + "[signal]\ntrials = 1\n" + ONE, ("signal.trials: 1 is not a whole number", "from 2")),
    "seed_negative": (MOTION + "[signal]\nseed = -1\n" + ONE, ("signal.seed: -1 is not a whole number",)),
    "snr_text": (MOTION + '[signal]\nsnr_db = "loud"\n' + ONE, ("signal.snr_db: 'loud' is not a number",)),
    "own_signal": (MOTION + ONE + "signal = { colour = 1 }\n", ("oscillator.1.signal: has 'colour'", "write signal =")),
    "own_signal_list": (MOTION + ONE + "signal = [1]\n", ("oscillator.1.signal: [1] is not a table", "write signal =")),
    "tolerance": (
        '[study]\nask = "order-needed"\n' + GRID + "tolerances = [0]\n" + ONE,
        ("line 6, grid.tolerances: holds 0", "between 0 and 1"),
    ),
    "damping_twice": (
        '[study]\nask = "decay-error"\n[grid]\ndamping = [0.01]\namplitudes = [1]\nmethods = ["hilbert"]\n'
        + ONE
        + "parameters = { mu = 0.1 }\n",
        ("line 4, grid.damping", "keep one"),
    ),
    "damping_missing": (
        '[study]\nask = "decay-error"\n[grid]\ndamping = [0.01]\namplitudes = [1]\n'
        'methods = ["hilbert"]\n[[oscillator]]\nsystem = "toda"\n',
        ("line 4, grid.damping: toda has no parameter mu",),
    ),
}
"""By name: the text of the file, and what is said of it."""

TEXTS: Mapping[str, str] = {
    **{f"study_{name}.toml": text for name, (text, _) in BROKEN.items()},
    "study_good.toml": HEAD + GRID + ONE,
    "study_beyond.toml": HEAD + GRID.replace("0.5, 1", "4") + ONE,
    "no_store.db": "time_s,u\n0,1\n" * 40,
}
"""The files that the cases name."""

ASIDE = "-wal -shm"
FIRST = "$R study study_good.toml --store s.db -o /dev/null"
MADE = ("s.db",)

CASES: tuple[Case, ...] = (
    *(refused(f"study study_{name}.toml", f"study_{name}.toml", *words) for name, (_, words) in BROKEN.items()),
    refused("study study_good.toml --store no_store.db", "no_store.db", "--store"),
    refused("study study_good.toml --store decay.csv", "decay.csv", "--store"),
    unusable("study study_good.toml --store missing/s.db", "missing", "check the path"),
    unusable("study study_good.toml --store folder.csv", "folder.csv"),
    refused("study study_good.toml --against gone.db", "study_good.db is not there", "run its study first"),
    refused("study no_store.db --against no_store.db", "no_store.db"),
    refused("study no_store.db", "is a store", "--against"),
    refused("study study_good.toml --set orders=x", "orders", "'x'"),
    refused("study study_good.toml --set colour=1", "colour"),
    refused("study study_good.toml --set orders", "'orders'"),
    refused("study study_good.toml --workers 0", "0"),
    refused("study study_good.toml --workers 2 --scheduler tcp://127.0.0.1:9", "keep one"),
    refused("study study_good.toml --amplitudes 1", "use --set"),
    refused("study study_good.toml --certified", "use --set"),
    refused("study study_good.toml --method energy-integral", "--method"),
    refused("study study_good.toml --format yaml", "'yaml'", "is not one of"),
    refused("study study_good.toml --dry-run --set amplitudes=-1", "holds -1"),
    refused("study --example nosuch", "'nosuch'", "paper"),
    refused("study --example paper --orders 2", "--orders"),
    Case("study study_beyond.toml --store beyond.db", 3, ("2 of 2 cells have no value", "says why"), ("beyond.db",)),
    Case(
        f"{FIRST} && $R study study_good.toml --set orders=2 --store s.db", 2, ("orders", "another study"), MADE, True
    ),
    Case(
        f"{FIRST} && printf '%4096s' x | dd of=s.db conv=notrunc bs=1 seek=16 status=none && "
        "$R study study_good.toml --store s.db",
        2,
        ("s.db",),
        MADE,
        True,
    ),
)
