"""Formulas as MathML, by the library that sets those of the report: no script is fetched."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

LINES = re.compile(r"\\\\(?![a-z])")
"""Where a displayed formula is broken into lines."""


def mathml(latex: str, display: str) -> str:
    """A formula as a MathML element.

    >>> mathml("a^2", "inline")[:44]
    '<math xmlns="http://www.w3.org/1998/Math/Mat'
    """
    return str(convert(latex.strip(), display=display))


def visit_inline(translator: HTML5Translator, node: nodes.math) -> None:
    """Write a formula within a sentence."""
    translator.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def visit_block(translator: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula on lines of its own."""
    set_lines = "".join(f"<div>{mathml(line, 'block')}</div>" for line in LINES.split(node.astext()) if line.strip())
    translator.body.append(f'<div class="formula">{set_lines}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer under the name that ``html_math_renderer`` gives."""
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
