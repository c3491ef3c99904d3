"""Languages that come from another distribution."""

from __future__ import annotations

from importlib.metadata import EntryPoint

import pytest

from ridgeback.common import plugins as common
from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.codegen.languages import registry
from ridgeback.symbolic.codegen.languages.python import Python
from ridgeback.symbolic.codegen.program import Form
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find


class Shouting(Python):
    name = "shouting"

    def write(self, form: Form) -> str:
        return super().write(form).upper()


def test_another_distribution_adds_a_language(monkeypatch: pytest.MonkeyPatch) -> None:
    class Point(EntryPoint):
        def load(self) -> object:
            return Shouting() if self.name == "shouting" else object()

    points = tuple(Point(name, "elsewhere:language", registry.GROUP) for name in ("shouting", "broken"))
    monkeypatch.setattr(common, "entry_points", lambda group: points if group == registry.GROUP else ())
    registry.languages.cache_clear()
    try:
        assert "DEF OMEGA0" in generate(lindstedt(find("pendulum"), 2), "shouting")
        with pytest.raises(InputError, match="gives a object, not a Language"):
            generate(lindstedt(find("pendulum"), 2), "broken")
    finally:
        monkeypatch.undo()
        registry.languages.cache_clear()
