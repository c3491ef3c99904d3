"""What is proved of generated code for every oscillator of the catalogue: units in the last place in every mode.

    python -m benchmarks.bounds [ORDER] [NAME ...]

Prints the table of docs/reference/generated-code.md: omega0 of each series that has a range, up to the end that the
command line takes, with the single operations that it comes to.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from ridgeback.common.errors import InputError
from ridgeback.interface.derivation import derivation
from ridgeback.interface.source import known_form
from ridgeback.symbolic.codegen.modes.mode import cost
from ridgeback.symbolic.codegen.program import MODES, Form, Function
from ridgeback.symbolic.codegen.proofs.bounds import Bound, bound
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.systems.catalogue import catalogue
from ridgeback.symbolic.systems.oscillator import Oscillator

ORDER = 12


def told(form: Form, function: Function, found: Bound) -> str:
    """Units in the last place, or the error itself, and operations."""
    size = f"absolute {float(found.absolute):.1e}" if found.ulps is None else f"{float(found.ulps) + 5e-4:.3f}"
    return f"{size} ({cost(form, function)})"


def rows(oscillator: Oscillator, order: int) -> Iterator[str]:
    """A line for omega0 and one for its slope, where the series has a range."""
    series = derivation(oscillator, order)
    if not isinstance(series, Expansion):
        return
    forms = [known_form(oscillator, series, series, mode=mode) for mode in MODES]
    for i, function in enumerate(forms[0].functions[:2]):
        found = [(form, form.functions[i], bound(form, form.functions[i])) for form in forms]
        if function.domain.argument not in function.read() or any(one is None for *_, one in found):
            return
        end = f"{function.domain.high:.6g}" if i == 0 else "its slope"
        cells = " | ".join(told(form, made, one) for form, made, one in found if one is not None)
        print(f"| `{oscillator.name}` | {end} | {cells} |", flush=True)
        yield oscillator.name


def main() -> None:
    """Print the table."""
    order = int(sys.argv[1]) if len(sys.argv) > 1 else ORDER
    print(f"| order {order} | up to | {' | '.join(MODES)} |\n|---|---|{'---|' * len(MODES)}")
    for oscillator in catalogue():
        if len(sys.argv) > 2 and oscillator.name not in sys.argv[2:]:
            continue
        try:
            list(rows(oscillator, order))
        except InputError as reason:
            print(f"# {oscillator.name}: {reason}", file=sys.stderr)


if __name__ == "__main__":
    main()
