"""Equations as text: what is not an oscillator, what has no expansion, what would be code elsewhere."""

from __future__ import annotations

from tests.faults.trial import Case, done, refused

CASES: tuple[Case, ...] = (
    refused("derive --equation", "--equation", "requires an argument"),
    refused("derive --equation ''", "the expression '' is empty", "give something like"),
    refused("derive pendulum --equation \"u'' + u = 0\"", "both the system pendulum and", "keep one"),
    refused("derive --equation 'u'", "'u'", "write it with"),
    refused("derive --equation 'u = 0'", "'u = 0'", "write it with"),
    refused("derive --equation \"u''\"", "equation: the force does not restore for u >", "nothing oscillates"),
    refused("derive --equation \"u'' + u = 0 = 0\"", "an extra = at column", "an equation has"),
    refused("derive --equation \"u'' + = 0\"", "'='", "a number, a"),
    refused("derive --equation \"u'' + (u = 0\"", "the bracket opened at column", "add )"),
    refused("derive --equation \"u'' + u) = 0\"", "the bracket ) at column", "remove it or"),
    refused("derive --equation \"u''' + u = 0\"", "\"u'''\"", "only u' and"),
    refused("derive --equation \"u'' + v'' = 0\"", "'u'", "an oscillator has"),
    refused("derive --equation \"u'' + u + foo(u) = 0\"", "'foo'", "to multiply write"),
    refused("derive --equation \"u'' + u + sin = 0\"", "the function sin at column", "write sin(u)"),
    refused("derive --equation \"u'' + u + abs(u) = 0\"", "the force does not restore for u <", "nothing oscillates"),
    refused("derive --equation \"u'' + u + u**u = 0\"", "the exponent at column 14", "write other powers"),
    refused(
        "derive --equation \"u'' + u + u**(1/2) = 0\"", "sqrt(u) is not analytic on both sides", "rewrite that term"
    ),
    refused("derive --equation \"u'' + u + 1/u = 0\"", "1/u is not analytic on both sides", "rewrite that term"),
    refused("derive --equation \"u'' + u + log(u) = 0\"", "log(u) is not finite and", "rewrite that term"),
    refused("derive --equation \"u'' - u = 0\"", "equation: the origin is a", "measure the unknown"),
    refused("derive --equation \"u'' + 1 = 0\"", "equation: u = 0 is", "measure the unknown"),
    done("derive --equation \"u'' + u**3 = 0\"", "0.847213", "one power of A"),
    refused(
        "derive --equation \"u'' + u'*u' = 0\"", "equation: the force does not restore for u >", "nothing oscillates"
    ),
    refused("derive --equation \"u'' + u + t = 0\"", "'t'", "rename it if"),
    refused("derive --equation \"u'' + u + 1/0 = 0\"", "division by zero at column", "the denominator is"),
    refused("derive --equation \"u'' + u + 1e400 = 0\"", "'1e400'", "choose units in"),
    refused(
        "derive --equation \"u'' + u + u**1000000000 = 0\"",
        "the exponent 1000000000 at column",
        "numerator and denominator",
    ),
    refused(
        "derive --equation \"u'' + u + 9**9**9**9*u**3 = 0\"",
        "the exponent 387420489 at column",
        "numerator and denominator",
    ),
    refused("derive --equation \"u'' + u + u**3 = 0; import os\"", "';'", "names, numbers, +"),
    refused(
        "derive --equation \"u'' + u + __import__('os').system('touch stolen') = 0\"",
        "the prime at column 22",
        "write the derivative",
    ),
    refused("derive --equation \"u'' + u + lambda: 3 = 0\"", "':'", "names, numbers, +"),
    refused("derive --equation \"u'' + u + u[0] = 0\"", "'['", "type ( from"),
    refused("derive --equation \"u'' + u + u.real = 0\"", "'.'", "names, numbers, +"),
    refused("derive --equation \"u'' + u + 'a' = 0\"", "the prime at column 11", "write the derivative"),
    refused("derive --equation \"u'' + u + 1_0*u**3 = 0\"", "'_0'", "write 1*_0"),
    refused("derive --equation \"u'' + u + 0x10*u**3 = 0\"", "'x10'", "write 0*x10"),
    done("derive --equation \"u'' + u + I*u = 0\""),
    done("derive --equation \"u'' + u + oo*u = 0\""),
    refused("derive --equation \"0*u'' + u = 0\"", "the second derivative cancels out", "an oscillator needs"),
    refused("derive --equation \"u''**2 + u = 0\"", "' enters through u + u'", "it must enter"),
    refused("derive --equation \"sin(u'') + u = 0\"", "' enters through u + sin(u'", "it must enter"),
    refused("derive --equation \"u'' - u + u**3 = 0\" --about 2", "about 2 is not an"),
    refused("derive --equation \"u'' - u + u**3 = 0\" --about k", "'k'", "use e.g. 1"),
    refused("derive --equation \"u'' - u + u**3 = 0\" --about nan", "'nan'", "use e.g. 1"),
    refused("derive --equation \"u'' - u + u**3 = 0\" --about", "--about", "requires an argument"),
    refused("derive --equation \"u'' - u + u**3 = 0\" --about 'u'", "'u'", "use e.g. 1"),
    done("generate --equation \"u'' + u + while*u**3 = 0\""),
    done("generate --equation \"u'' + u + lambda*u**3 = 0\" --language python"),
    refused("simulate --equation \"u'' + c*u = 0\"", "equation: parameter c has no", "set it, e.g."),
    refused("simulate --equation \"u'' - u = 0\"", "equation: the origin is a", "measure the unknown"),
    refused(
        "estimate decay.csv --method model-fit --equation \"u'' = 0\"",
        "equation: the force does not restore for u >",
        "nothing oscillates",
    ),
    refused(
        "estimate decay.csv --method model-fit --system pendulum --equation \"u'' + u = 0\"",
        "both the system pendulum and",
        "keep one",
    ),
)
