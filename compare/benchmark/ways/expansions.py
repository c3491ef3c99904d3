"""The contenders that come from theory: what each gives along the motion, and what a value costs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.ways.contender import Contender, amplitudes, refused
from ridgeback.compare.benchmark.ways.formulas import arguments, evaluated, fits, resummations, series
from ridgeback.compare.benchmark.ways.slow_flows import slow_flows
from ridgeback.compare.benchmark.ways.yardsticks import yardsticks
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.study.derived import backbone_series, without_damping
from ridgeback.symbolic.expansion.expansion import Expansion

ORDERS = (2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 24, 28, 32, 36, 40)


def theory(
    motion: Motion,
    orders: Iterable[int],
    step: Callable[[str], None],
    *,
    known: Expansion | None = None,
    timed: bool = True,
) -> Iterator[Contender]:
    """Every contender from theory that this motion has; ``known`` is the series, where it is derived already.

    Where times are not wanted nothing runs for them.
    """
    sources = amplitudes(motion)
    rest = without_damping(motion.setting.oscillator).oscillator
    wanted = sorted(orders)
    step("expansions, derived and generated")
    try:
        expansion = backbone_series(rest, wanted[-1]) if known is None else known.truncated(wanted[-1])
    except InputError as error:
        yield refused("lindstedt", "perturbation expansion", "expansion", str(error))
    else:
        at = arguments(motion, expansion, sources)
        tried = list(series(expansion, wanted))
        step("resummations and fits")
        tried += resummations(rest, expansion, at) if expansion.variable != "eps" else ()
        tried += fits(motion, rest, at) if motion.has_backbone else ()
        yield from evaluated(tried, at, timed=timed)
    step("slow flow by order")
    yield from slow_flows(motion, timed=timed)
    yield from yardsticks(motion, sources, timed=timed)
