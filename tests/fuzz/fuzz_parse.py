"""Coverage-guided fuzzing of the equation reader with atheris; not collected by pytest.

    python tests/fuzz/fuzz_parse.py -max_total_time=20 -max_len=400

Whatever the text: InputError in one printable line, or a tree that prints back to itself and becomes an oscillator
or an InputError.  Anything else, a hang included, stops the run with the input that caused it.
"""

import sys

WORDS = (
    "u u' u'' + - * / ** ^ ( ) = 2 3 0 1/2 0.5 1e3 200 k mu eps pi sin( cos( tan( sinh( cosh( tanh( exp( log( sqrt( "
    "asin( atan( asinh( atanh( t ln( abs( sign( max( min( ' . , é ’ −"
)
VOCABULARY = WORDS.split()
LEAVES = ("u", "u'", "k", "mu", "2", "1", "1/3", "pi", "0.1")
CALLS = [word for word in VOCABULARY if len(word) > 1 and word.endswith("(")]
POWERS = ("**2", "**3", "**-1", "**(1/2)", "**(-2/3)", "**7")
BOUNDS = ("-max_total_time=20", "-max_len=400", "-timeout=180")


def text_from(data):
    """The first byte says how the rest is read: as text, as words of the grammar, or as steps that build a tree."""
    if not data or data[0] % 3 == 0:
        return data[1:].decode("utf-8", errors="surrogateescape")
    if data[0] % 3 == 1:
        return "u'' + " + " ".join(VOCABULARY[byte % len(VOCABULARY)] for byte in data[1:])
    return "u'' + u + " + well_formed(data[1:])


def well_formed(data):
    """A text that always parses: a stack machine whose steps push a leaf or join what is on top."""
    stack = ["u"]
    for byte in data:
        choice, rest = byte % 4, byte // 4
        if choice == 0:
            stack.append(LEAVES[rest % len(LEAVES)])
        elif choice == 1:
            stack.append(f"{CALLS[rest % len(CALLS)]}{stack.pop()})")
        elif choice == 2:
            stack.append(f"({stack.pop()}){POWERS[rest % len(POWERS)]}")
        elif len(stack) > 1:
            right, left = stack.pop(), stack.pop()
            stack.append(f"({left}{'+-*/'[rest % 4]}{right})")
    return "+".join(stack)


def main():
    import atheris

    with atheris.instrument_imports(include=["ridgeback.symbolic"]):
        from ridgeback.common.errors import InputError
        from ridgeback.symbolic.grammar.parse import parse_equation, parse_expression, parse_number, to_text
        from ridgeback.symbolic.systems.oscillator import Oscillator

    def attempt(read, text):
        try:
            return read(text)
        except InputError as error:
            if not str(error).isprintable():
                raise AssertionError(f"message {str(error)!r} is not one printable line") from error
            return None

    def one_input(data):
        text = text_from(data)
        attempt(parse_number, text)
        attempt(parse_expression, text)
        equation = attempt(parse_equation, text)
        if equation is None:
            return
        again = to_text(equation.left, unknown=equation.unknown)
        if parse_expression(again, unknown=equation.unknown) != equation.left:
            raise AssertionError(f"{text!r} prints as {again!r}, which is another tree")
        oscillator = attempt(Oscillator.from_equation, text)
        if oscillator is not None:
            attempt(lambda _: oscillator.normalised, text)  # refused where the law has a kink
            if not oscillator.equation_latex.isprintable():
                raise AssertionError(f"the LaTeX of {text!r} is not one line")

    given = [argument.partition("=")[0] for argument in sys.argv]
    defaults = [bound for bound in BOUNDS if bound.partition("=")[0] not in given]
    bounded = [bound for bound in defaults if not (bound.startswith("-max_total_time") and "-runs" in given)]
    atheris.Setup([*sys.argv, *bounded], one_input)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
