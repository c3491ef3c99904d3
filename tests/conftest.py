"""For all tests: properties take the time they need, and where ``CI`` is set they are the same each time."""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, settings

PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])  # a loaded machine is no fault
settings.register_profile("here", PATIENT)
settings.register_profile("ci", PATIENT, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")
pytest.register_assert_rewrite("tests.pages.page_rules", "tests.numeric.holding")
