"""Programs that print the bits of generated functions over a grid, one for each language that runs by itself."""

from __future__ import annotations

from ridgeback.symbolic.codegen.program import Form

POINTS = 200
STEP = "0.015"
"""Grid: i*STEP for i = 0 ... POINTS - 1; the product is rounded alike everywhere."""


def c(form: Form) -> dict[str, str]:
    calls = "\n".join(f"show({form.name}_{f.name}(i*{STEP}, 1.0));" for f in form.functions)
    return {
        "bits.c": f'''#include <stdio.h>
#include <string.h>
#include <stdint.h>
#include "{form.name}.h"
static void show(double x) {{ uint64_t b; memcpy(&b, &x, 8); printf("%016llx\\n", (unsigned long long)b); }}
int main(void) {{ for (int i = 0; i < {POINTS}; i++) {{ {calls} }} return 0; }}
'''
    }


def cpp(form: Form) -> dict[str, str]:
    calls = "\n".join(f"show({form.name}::{f.name}(i*{STEP}, 1.0));" for f in form.functions)
    return {
        "bits.cpp": f'''#include <cstdio>
#include <cstring>
#include <cstdint>
#include "{form.name}.hpp"
static void show(double x)
{{ std::uint64_t b; std::memcpy(&b, &x, 8); std::printf("%016llx\\n", (unsigned long long)b); }}
int main() {{ for (int i = 0; i < {POINTS}; i++) {{ {calls} }} return 0; }}
'''
    }


def rust(form: Form) -> dict[str, str]:
    calls = "\n".join(f'println!("{{:016x}}", m::{f.name}(i as f64*{STEP}, 1.0).to_bits());' for f in form.functions)
    return {"bits.rs": f'#[path = "src/lib.rs"]\nmod m;\nfn main() {{ for i in 0..{POINTS} {{ {calls} }} }}\n'}


def fortran(form: Form) -> dict[str, str]:
    calls = "\n".join(
        f"print '(z16.16)', transfer({f.name}(real(i, real64)*{STEP}_real64, 1.0_real64), 1_int64)"
        for f in form.functions
    )
    return {
        "bits.f90": f"""program bits
use {form.name}
use, intrinsic :: iso_fortran_env, only: real64, int64
implicit none
integer :: i
do i = 0, {POINTS - 1}
{calls}
end do
end program bits
"""
    }


def matlab(form: Form) -> dict[str, str]:
    rows = "; ".join(f"f.{f.name}(x, 1.0)" for f in form.functions)
    return {
        "bits.m": f"f = {form.name}(); x = (0:{POINTS - 1})*{STEP}; v = [{rows}];\n"
        'h = num2hex(v(:)); for i = 1:rows(h), puts([h(i, :) "\\n"]); end\n'
    }


def javascript(form: Form) -> dict[str, str]:
    calls = "\n".join(f"show(m.{f.name}(i*{STEP}, 1));" for f in form.functions)
    return {
        "bits.mjs": f"""import * as m from "./index.mjs";
const v = new Float64Array(1), b = new BigUint64Array(v.buffer);
const show = (x) => {{ v[0] = x; console.log(b[0].toString(16).padStart(16, "0")); }};
for (let i = 0; i < {POINTS}; i++) {{ {calls} }}
"""
    }


def python(form: Form) -> dict[str, str]:
    calls = "\n    ".join(f"print(struct.pack('>d', m.{f.name}(i*{STEP}, 1.0)).hex())" for f in form.functions)
    return {"bits.py": f"import struct\nimport {form.name} as m\nfor i in range({POINTS}):\n    {calls}\n"}


def arrays(form: Form) -> dict[str, str]:
    """Of modules whose functions take arrays."""
    rows = ", ".join(f"m.{f.name}(x, 1.0)" for f in form.functions)
    return {
        "bits.py": f"import struct\nimport numpy as np\nimport {form.name} as m\nx = np.arange({POINTS})*{STEP}\n"
        f"for v in np.stack([{rows}]).T.ravel():\n    print(struct.pack('>d', v).hex())\n"
    }


DRIVERS = {
    "python": (python, ()),
    "array-api": (arrays, ()),
    "numba": (python, ()),
    "c": (c, ("-std=c99", "-O3", "-march=native", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o", "bits")),
    "cpp": (cpp, ("-std=c++17", "-O3", "-march=native", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o", "bits")),
    "rust": (rust, ("-O", "-C", "target-cpu=native", "-A", "dead_code", "-o", "bits", "bits.rs")),
    "fortran": (fortran, ("-O3", "-march=native", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-o", "bits")),
    "matlab": (matlab, ()),
    "javascript": (javascript, ()),
}
