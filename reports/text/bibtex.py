r"""A page as an entry of a bibliography."""

from __future__ import annotations

import re
import unicodedata

from ridgeback.compare.report.results import Provenance

SPECIAL = {"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}


def bibtex(made: Provenance, title: str) -> str:
    r"""A ``@misc`` entry: what was found, by which version, with which command and settings.

    >>> made = Provenance("ridgeback report", {"ridgeback": "0.1.0"}, {}, "0123456789abcdef")
    >>> print(bibtex(made, "5 % at A_0"))
    @misc{ridgeback-01234567,
      title = {{5 \% at A\_0}},
      author = {{Ridgeback 0.1.0}},
      note = {\texttt{ridgeback report}; settings 0123456789abcdef},
    }
    """
    version = made.versions.get("ridgeback", "")
    command = rf"\texttt{{{escaped(made.command)}}}; " if made.command else ""
    return (
        f"@misc{{ridgeback-{made.settings_hash[:8]},\n"
        f"  title = {{{{{escaped(title)}}}}},\n"
        f"  author = {{{{Ridgeback {version}}}}},\n"
        f"  note = {{{command}settings {made.settings_hash}}},\n"
        "}"
    )


def escaped(text: str) -> str:
    r"""Text in which nothing is a command of TeX, without characters that control.

    >>> escaped("50 % of {x}"), escaped("a\nb")
    ('50 \\% of \\{x\\}', 'a b')
    """
    clean = "".join(" " if unicodedata.category(c) == "Cc" else c for c in text)
    return re.sub(r"[\\{}~^%&#_$]", lambda found: SPECIAL.get(found[0], "\\" + found[0]), clean)
