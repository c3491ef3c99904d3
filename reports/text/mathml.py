"""LaTeX to MathML, checked: well-formed, only MathML elements, no command left over; and set as a book sets it.

The conversion is latex2mathml's.  What a browser would get wrong from it is put right on the tree: function
names upright with a thin space, upright d, primes as operators, dots as accents.
"""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

from latex2mathml.converter import convert

from ridgeback.compare.study.results import Formula

_NAMESPACE = "http://www.w3.org/1998/Math/MathML"
_ELEMENTS = frozenset(
    "math mrow mi mn mo mtext mspace mfrac msqrt mroot msub msup msubsup mover munder munderover mstyle mtable mtr mtd "
    "mpadded mphantom".split()
)
_ATTRIBUTES = frozenset(
    "accent columnalign depth display displaystyle fence form height linethickness lspace mathsize mathvariant maxsize "
    "minsize movablelimits rspace scriptlevel separator stretchy symmetric width".split()
)
_ACCENTS = frozenset("¨˙~ˆ¯^→")
_DOTS = {"˙": ".", "¨": ".."}
_PRIMES = frozenset("′″‴")


class FormulaError(ValueError):
    """The LaTeX of a formula could not be turned into sound MathML."""


def mathml(latex: str, *, display: bool = False) -> str:
    r"""Convert LaTeX into one ``<math>`` element.

    Raises FormulaError when the LaTeX cannot be read, leaves a command unconverted, or hides other markup.

    >>> mathml("a'")
    '<math><mrow><msup><mi>a</mi><mo>′</mo></msup></mrow></math>'
    >>> mathml(r"\nonsense x")
    Traceback (most recent call last):
        ...
    ridgeback.reports.text.mathml.FormulaError: unknown LaTeX command \nonsense in \nonsense x
    """
    tree = _parse(latex)
    for element in tree.iter():
        _check(element, latex)
    _polish(tree)
    tree.attrib.pop("xmlns", None)
    tree.attrib.pop("display", None)
    if display:
        tree.set("display", "block")
    return ET.tostring(tree, encoding="unicode")


def _parse(latex: str) -> ET.Element:
    upright = re.sub(r"\\(?:mathrm|mathop)\{(\w+)\}", r"\\operatorname{\1}", latex)
    try:
        # Only what latex2mathml has just written is parsed: no document type, no entities from outside.
        tree = ET.fromstring(convert(upright))  # noqa: S314
    except Exception as error:  # its many private exception types all mean: not readable
        raise FormulaError(f"LaTeX cannot be converted: {latex}") from error
    for element in tree.iter():
        element.tag = element.tag.removeprefix(f"{{{_NAMESPACE}}}")
    return tree


def _check(element: ET.Element, latex: str) -> None:
    if element.tag not in _ELEMENTS:
        raise FormulaError(f"<{element.tag}> is not allowed in a formula: {latex}")
    foreign = set(element.attrib) - _ATTRIBUTES
    if foreign:
        raise FormulaError(f"attribute {min(foreign)} is not allowed in a formula: {latex}")
    if (element.text or "").startswith("\\"):
        raise FormulaError(f"unknown LaTeX command {element.text} in {latex}")


def _polish(tree: ET.Element) -> None:
    for parent in list(tree.iter()):
        for child in parent:
            _set_token(child)
        if parent.tag in ("mrow", "math", "mtd", "mstyle"):
            _space_functions(parent)
        if parent.tag == "mover" and len(parent) == 2 and (parent[1].text or "") in _ACCENTS:
            _set_accent(parent)


def _set_accent(over: ET.Element) -> None:
    """Time derivatives as full stops stacked over the letter.

    Without an OpenType mathematics font a browser draws the accents U+02D9 and U+00A8 into the letter; stacked scripts
    it sets clear of it with any font.
    """
    dots = _DOTS.get(over[1].text or "")
    over.set("accent", "false" if dots else "true")
    if dots:
        over[1].text = dots
        over[1].attrib.clear()
        over[1].attrib.update({"stretchy": "false", "lspace": "0", "rspace": "0"})


def _set_token(element: ET.Element) -> None:
    text = element.text or ""
    if element.tag == "mi" and text in _PRIMES:
        element.tag = "mo"
    if element.tag == "mo" and text.isalpha() and text.isascii():
        element.tag = "mi"
        element.attrib.clear()
        element.set("mathvariant", "normal")


def _is_function(element: ET.Element) -> bool:
    head = element[0] if element.tag in ("msup", "msub") and len(element) else element
    text = head.text or ""
    return head.tag == "mi" and len(text) > 1 and text.isalpha()


def _space_functions(row: ET.Element) -> None:
    children = list(row)
    for i, child in enumerate(children):
        if not _is_function(child):
            continue
        if i > 0 and children[i - 1].tag not in ("mo", "mspace"):
            row.insert(list(row).index(child), ET.Element("mspace", width="0.167em"))
        if i + 1 < len(children) and children[i + 1].tag not in ("mo", "mspace"):
            row.insert(list(row).index(child) + 1, ET.Element("mspace", width="0.167em"))


def term_parts(terms: tuple[str, ...]) -> tuple[str, ...]:
    r"""Give every term after the first its sign, so that each can stand at the beginning of a line.

    >>> term_parts(("1", r"-\frac{1}{16} A^2", "x"))
    ('1', '-\\frac{1}{16} A^2', '+x')
    """
    return tuple(term if i == 0 or term.lstrip().startswith(("+", "-")) else f"+{term}" for i, term in enumerate(terms))


def _infix(markup: str) -> str:
    """Space a leading sign as between two terms, not as the sign of a number."""
    return re.sub(r"^<math([^>]*)><mrow><mo>([+−])</mo>", r'<math\1><mrow><mo form="infix">\2</mo>', markup)


def formula_mathml(formula: Formula) -> tuple[str, ...]:
    r"""Return the ``<math>`` elements of a formula: the left side with its sign of equality, then each term.

    >>> len(formula_mathml(Formula(title="", left=r"\omega_0", terms=("1", r"-\frac{1}{16}A^{2}"))))
    3
    """
    head = (mathml(f"{formula.left} ="),) if formula.left else ()
    first, *rest = term_parts(formula.terms) or ("",)
    body = (mathml(first, display=False),) if first else ()
    return head + body + tuple(_infix(mathml(term)) for term in rest)


def formula_latex(formula: Formula) -> str:
    r"""Return the whole relation as one line of LaTeX.

    >>> formula_latex(Formula(title="", left="w", terms=("1", "-A^2")))
    'w = 1 -A^2'
    """
    right = " ".join(term_parts(formula.terms))
    return f"{formula.left} = {right}" if formula.left else right
