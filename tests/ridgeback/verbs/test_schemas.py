"""Every verb's JSON has a schema in docs/schemas; ``conftest`` holds each JSON that a test asks for against it."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

import jsonschema
import pytest

from ridgeback.cli import VERBS

SCHEMAS = Path(__file__).parents[3] / "docs" / "schemas"

CHEAP = """
systems
systems pendulum
derive pendulum --order 2 --at 1
derive pendulum --order 2 --verify
derive duffing --order 4 --resummed pade --at 1
derive damped-pendulum --order 2 --transient 0.5 --until 5
derive damped-pendulum --order 2 --harmonics
derive van-der-pol --method multiple-scales --weight 1 --order 2
derive --equation "u'' + u**(1/3) = 0" --order 0 --at 1
generate pendulum --order 2
simulate pendulum --duration 5 --rate 4 --initial 1,0
sample decay
study pendulum --orders 2 --amplitudes 1 --certified
doctor
"""


def test_every_verb_has_one_and_its_name_is_its_version() -> None:
    found = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in SCHEMAS.glob("*.json")}
    assert {stem.rpartition("-")[0] for stem in found} == set(VERBS)
    for stem, schema in found.items():
        jsonschema.Draft202012Validator.check_schema(schema)
        name, _, version = stem.rpartition("-")
        assert schema["$id"] == f"urn:ridgeback:schema:{name}:{version}"


@pytest.mark.parametrize("line", CHEAP.strip().splitlines())
def test_what_is_printed_keeps_to_it(line: str, ridgeback) -> None:  # type: ignore[no-untyped-def]
    assert ridgeback(*shlex.split(line), "--format", "json").code == 0


def test_a_key_of_another_type_would_be_seen(ridgeback) -> None:  # type: ignore[no-untyped-def]
    schema = json.loads((SCHEMAS / "derive-1.json").read_text(encoding="utf-8"))
    found = json.loads(ridgeback("derive", "pendulum", "--order", "2", "--format", "json").out)
    found["frequency"][0]["coefficient"] = 1
    with pytest.raises(jsonschema.ValidationError, match="1 is not of type 'string'"):
        jsonschema.validate(found, schema)
