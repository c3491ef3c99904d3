"""One term of a slow flow."""

from __future__ import annotations

from dataclasses import dataclass

import sympy


@dataclass(frozen=True)
class Term:
    """One term ``coefficient * a^powers[0] * m_1^powers[1] * m_2^powers[2] ...``."""

    powers: tuple[int, ...]
    coefficient: sympy.Expr
