"""An equation of a class as it is written in text, set as mathematics."""

from __future__ import annotations

import re

from ridgeback.reports.text.mathml import FormulaError, mathml

GREEK = ("alpha", "beta", "gamma", "delta", "epsilon", "eps", "mu", "nu", "omega", "theta", "phi")
FUNCTIONS = ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log")


def equation_latex(text: str) -> str:
    """LaTeX of an equation such as ``u'' + 2 mu u' + k^2 u = 0``; words that are no symbol stay words.

    >>> equation_latex("u'' + 2*mu*u' + k**2*u + c3*u**3 = 0").replace(chr(92), "~")
    '~ddot{u} + 2 ~mu ~dot{u} + k^{2} u + c_{3} u^{3} = 0'
    """
    latex = text.replace("**", "^").replace("*", " ")
    latex = re.sub(r"([A-Za-z]+)''", r"\\ddot{\1}", latex)
    latex = re.sub(r"([A-Za-z]+)'", r"\\dot{\1}", latex)
    latex = re.sub(r"(?<![\\\\A-Za-z{])([A-Za-z]+)(\d+)(?![A-Za-z])", r"\1_{\2}", latex)
    latex = re.sub(r"\^(\d+)", r"^{\1}", latex)
    latex = re.sub(r"\bsign\(", r"\\operatorname{sign}(", latex)
    for name in (*GREEK, *FUNCTIONS):
        latex = re.sub(rf"(?<![\\\\A-Za-z]){name}(?![A-Za-z])", rf"\\{'varepsilon' if name == 'eps' else name}", latex)
    return latex


SLOW_FLOW = re.compile(r"^phi' = (.*), a'/a( and the rest of phi')? as of (.*)$")
"""How a class without an equation of motion is written: its slow flow."""


def class_mathml(text: str) -> str:
    """The equation of a class, or its slow flow, set.

    >>> class_mathml("phi' = w0 + w2 a^2, a'/a as of 2 mu u'").count("<math")
    2
    """
    flow = SLOW_FLOW.match(text)
    if flow is None:
        return equation_mathml(text) or between_words(text)
    phase = "phi' = " + re.sub(r"\bw(\d)", r"omega\1", flow[1])
    parts = [equation_mathml(phase), equation_mathml(flow[3])]
    what = "damping and its share of the frequency" if flow[2] else "damping"
    return f"{parts[0]}, {what} as of {parts[1]}" if all(parts) else ""


BETWEEN = re.compile(r",? \b(for|with|in place of|beyond|and|or)\b ")
"""Words between the parts of a force that is another one in another place."""


def between_words(text: str) -> str:
    """Each part between such words set; empty where one of them cannot be.

    >>> between_words("r = k1^2 u for u > 0").count("<math"), between_words("no equation for u")
    (2, '')
    """
    *parts, last = BETWEEN.split(text)
    sides = [*(equation_mathml(part) for part in parts[::2]), equation_mathml(last)]
    if not parts or not all(sides):
        return ""
    words = [match[0] for match in BETWEEN.finditer(text)]
    return sides[0] + "".join(word + side for word, side in zip(words, sides[1:], strict=True))


def equation_mathml(text: str) -> str:
    """One ``<math>`` element; empty where the text holds words that are no symbols."""
    if set(re.findall(r"[A-Za-z]{2,}", text)) - {*GREEK, *FUNCTIONS, "sign"}:
        return ""
    try:
        return mathml(equation_latex(text))
    except FormulaError:
        return ""
