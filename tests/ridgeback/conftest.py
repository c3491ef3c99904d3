"""Running the command line inside the test's own process; what it prints as JSON is held against its schema."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import jsonschema
import pytest

from ridgeback.cli import main

SCHEMAS = Path(__file__).parents[2] / "docs" / "schemas"
FEW = 8


class Result(NamedTuple):
    """Exit code, standard output, standard error."""

    code: int
    out: str
    err: str


Ridgeback = Callable[..., Result]


@pytest.fixture
def ridgeback(capsys: pytest.CaptureFixture[str]) -> Ridgeback:
    """The command line as a function of its arguments."""

    def run(*arguments: str) -> Result:
        capsys.readouterr()
        code = main(arguments)
        captured = capsys.readouterr()
        if "json" in arguments[1:] and arguments[arguments.index("json") - 1] == "--format" and captured.out:
            keeps_to_its_schema(arguments[0], json.loads(captured.out))
        return Result(code, captured.out, captured.err)

    return run


@cache
def validator(verb: str) -> Any:
    """The newest schema of a verb's JSON, checked itself."""
    newest = max(SCHEMAS.glob(f"{verb}-*.json"), key=lambda path: int(path.stem.rpartition("-")[2]))
    schema = json.loads(newest.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def keeps_to_its_schema(verb: str, value: Any) -> None:
    """Every key has its type, and every key of the whole is in the schema."""
    checked = validator(verb)
    checked.validate(shortened(value))
    known = {key for part in (checked.schema, *checked.schema.get("anyOf", ())) for key in resolved(checked, part)}
    if isinstance(value, dict) and known:
        assert set(value) <= known, f"not in docs/schemas/{verb}: {sorted(set(value) - known)}"


def resolved(checked: Any, part: dict[str, Any]) -> dict[str, Any]:
    """The properties of a part of a schema, a reference followed."""
    name = part.get("$ref", "").rpartition("/")[2]
    found: dict[str, Any] = (checked.schema["$defs"][name] if name else part).get("properties", {})
    return found


def shortened(value: Any) -> Any:
    """The same with the middle of long lists left out, which costs time and says nothing."""
    match value:
        case dict():
            return {key: shortened(item) for key, item in value.items()}
        case list() if len(value) > 2 * FEW:
            return [shortened(item) for item in (*value[:FEW], *value[-FEW:])]
        case list():
            return [shortened(item) for item in value]
    return value
