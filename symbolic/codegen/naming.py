"""Names that are legal and free in every target language: whitelisted, and not of words that mean something there."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable
from typing import Final

from ridgeback.common.errors import InputError

_C: Final = """
auto break case char const continue default do double else enum extern float for goto if inline int long register
restrict return short signed sizeof static struct switch typedef union unsigned void volatile while main
_Bool _Complex _Imaginary _Alignas _Alignof _Atomic _Generic _Noreturn _Static_assert _Thread_local _BitInt _Decimal32
_Decimal64 _Decimal128 _Float16 _Float32 _Float64 _Float128 alignas alignof bool constexpr false nullptr static_assert
thread_local true typeof typeof_unqual asm fortran near far huge linux unix i386 vax sun complex imaginary I NULL NAN
INFINITY HUGE_VAL EOF BUFSIZ FILE errno assert stdin stdout stderr isnan isfinite isinf signbit fabs abs sqrt floor fma
fmin fmax pow exp log sin cos size_t ptrdiff_t printf puts offsetof va_list true_ DBL_MAX FLT_MAX M_PI noreturn
"""
_CPP: Final = """
and and_eq bitand bitor catch class co_await co_return co_yield compl concept const_cast consteval constinit char8_t
char16_t char32_t decltype delete dynamic_cast explicit export friend mutable namespace new noexcept not not_eq
operator or or_eq private protected public reinterpret_cast requires static_cast template this throw try typeid
typename using virtual wchar_t xor xor_eq std import module final override size_type
"""
_RUST: Final = """
as async await become box crate dyn enum fn impl in let loop macro match mod move mut override priv pub ref self Self
super trait type unsafe unsized use where yield gen union f32 f64 i8 i16 i32 i64 u8 u16 u32 u64 usize isize str
"""
_JULIA: Final = """
baremodule begin end function global local macro module quote struct abstract mutable primitive elseif finally
isa outer ccall muladd im pi NaN Inf Float64 Float32 Int Vector Base Core Main
"""
_MATLAB: Final = """
classdef elseif otherwise parfor persistent spmd switch endif endwhile endfor endfunction end_try_catch until
unwind_protect ans eps i j pi inf nan NaN Inf NA e
single logical numel size zeros ones typecast bitand num2hex isequaln varargin nargin
"""
_JAVASCRIPT: Final = """
arguments await debugger eval finally function implements in instanceof interface let null package super undefined var
with yield Math Number NaN Infinity Object Array Float64Array Float32Array BigInt64Array globalThis
window self isNaN of get set
"""
_FORTRAN: Final = """
program subroutine module use implicit none real integer logical character parameter intent elemental pure
contains end call allocate wp ieee_arithmetic ieee_value iso_fortran_env entry data stop result where forall select
"""
_PYTHON: Final = """
math np numpy xp numba njit float len list range type isinstance array print self None True False nan inf
"""
_OWN: Final = """
k omega0 omega0_slope amplitude
amplitude_rate growth_rate growth_rate a A out count index table values motion mean t i j n w
root_of_amplitude size result quotient h half_step middle ends sixth k_inverse scaled natural_frequency phi
rest root fall rise inner moved distance vanishing grown half_angle
total gap area ratio ell theta theta_squared turn taken pairs odd sign even uneven cosine sine twice u high low
high_share low_share high_inside low_inside rounded product lost sum_low share head fraction block
start stop size point points expected given failed
"""
_TAKEN: Final = frozenset(" ".join((_C, _CPP, _RUST, _JULIA, _MATLAB, _JAVASCRIPT, _FORTRAN, _PYTHON, _OWN)).split())
_FOLDED: Final = frozenset(word.lower() for word in _TAKEN)
"""Fortran does not tell capitals from small letters."""
# Horner's intermediate results, what is computed from an argument, and the prefixes of what is computed inside.
_MADE: Final = re.compile(
    r"[yz]\d*(_\d+)*|[cs]_sum\d*|([aw]\d*|at|[cs]\d+|omega0|self|total|low|high|root|part)_.*"
    r"|.*_(squared|scaled|unchecked|array|rise|test|value|\d+|(by|times)_k(_\d+)?|[hlabrt]{1,2})|__.*"
)
_IDENTIFIER: Final = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
LONGEST: Final = 40
"""Characters of a name: with what is added to it a Fortran name may have 63."""


def argument_name(name: str) -> str:
    """A parameter's name as an argument's; one that means something else in some language gets an underscore.

    Other characters than ASCII letters, digits and single underscores become ``x``.

    >>> [argument_name(name) for name in ("mu", "lambda", "double", "y", "_Bool", "nullptr", "REAL", "c3")]
    ['mu', 'lambda_', 'double_', 'y_', 'x_Bool', 'nullptr_', 'REAL_', 'c3']
    """
    plain = re.sub(r"_{2,}", "_", re.sub(r"[^A-Za-z0-9_]", "x", name))[:LONGEST]
    plain = plain if _IDENTIFIER.fullmatch(plain) else f"x{plain}"
    return f"{plain}_" if is_taken(plain) else plain


def is_taken(name: str) -> bool:
    """Whether a name means something in a language, or in what is generated.

    >>> is_taken("constexpr"), is_taken("alpha3")
    (True, False)
    """
    return is_reserved(name) or _MADE.fullmatch(name) is not None


def is_reserved(name: str) -> bool:
    """Whether a name means something in a language.

    >>> is_reserved("nullptr"), is_reserved("pendulum_40")
    (True, False)
    """
    return keyword.iskeyword(name) or keyword.issoftkeyword(name) or name.lower() in _FOLDED


def variable_name(name: str) -> str:
    """The same for the variable of a series: the amplitude A, or the small parameter of a limit cycle.

    >>> variable_name("A"), variable_name("eps"), variable_name("lambda")
    ('A', 'eps', 'lambda_')
    """
    return name if name in ("A", "eps") else argument_name(name)


def identifier(name: str) -> str:
    """A system's name as an identifier of every language.

    >>> identifier("helmholtz-duffing"), identifier("2nd"), identifier("class")
    ('helmholtz_duffing', 'system_2nd', 'class_model')
    """
    cleaned = re.sub(r"_{2,}", "_", re.sub(r"[^A-Za-z0-9_]+", "_", name)).strip("_")[:LONGEST].strip("_") or "system"
    cleaned = cleaned if cleaned[0].isalpha() else f"system_{cleaned}"
    return f"{cleaned}_model" if is_reserved(cleaned) else cleaned


def checked_identifier(name: str) -> str:
    """A name that a user chose for what is generated.

    Raises InputError unless it is an identifier of every language and means nothing in any.

    >>> checked_identifier("my_clock")
    'my_clock'
    """
    if not _IDENTIFIER.fullmatch(name) or len(name) > LONGEST or "__" in name or name.endswith("_"):
        raise InputError(
            f"name {name[:60]!r} is not usable in every language; use up to {LONGEST} letters, digits and single "
            "underscores, a letter first, e.g. my_clock"
        )
    if is_reserved(name):
        raise InputError(f"name {name!r} means something else in one of the languages; use e.g. {name}_model")
    return name


def argument_names(names: Iterable[str], *, free: tuple[str, ...] = ()) -> dict[str, str]:
    """The arguments' names by the parameters', no two alike even where only capitals differ, as Fortran takes them.

    Names that are ``free`` mean nothing in this code, though they do in other.

    >>> argument_names(("mu", "Mu", "lambda", "lambda_"))
    {'mu': 'mu', 'Mu': 'Mu_v2', 'lambda': 'lambda_', 'lambda_': 'lambda_v2'}
    """
    seen: set[str] = set()
    found = {}
    for name in names:
        plain, count = name if name in free else argument_name(name), 1
        while plain.lower() in seen:
            count += 1
            plain = f"{argument_name(name).rstrip('_')}_v{count}"
        seen.add(plain.lower())
        found[name] = plain
    return found
