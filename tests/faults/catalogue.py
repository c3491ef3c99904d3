"""All cases, by what they are about."""

from __future__ import annotations

from collections.abc import Mapping

from tests.faults.cases import (
    derivations,
    description_files,
    equations,
    other_verbs,
    processes,
    recording_files,
    recording_options,
    study_files,
)
from tests.faults.trial import Case

GROUPS: Mapping[str, tuple[Case, ...]] = {
    "`derive`: names, options, numbers": derivations.CASES,
    "equations as text": equations.CASES,
    "oscillators from TOML files": description_files.CASES,
    "`systems`, `generate`, `simulate`, `study`, `report`": other_verbs.CASES,
    "studies from TOML files, and their stores": study_files.CASES,
    "recordings: CSV, NPZ, NPY, WAV, MAT, HDF5": recording_files.CASES,
    "`estimate`, `identify`: options": recording_options.CASES,
    "environment: locale, home, terminal, limits": processes.ENVIRONMENT,
    "standard streams: closed, full, piped": processes.STREAMS,
    "names: gone folders, bytes that are no text, links": processes.NAMES,
    "interrupts and limits of the system": processes.LIMITS,
    "worker processes": processes.WORKING,
    "full and read-only disks": processes.DISKS if processes.disks_can_be_made() else (),
}

CASES = tuple(case for cases in GROUPS.values() for case in cases)
IN_PROCESS = tuple(case for case in CASES if not case.by_bash)
BY_BASH = tuple(case for case in CASES if case.by_bash)
WARM = (Case("derive pendulum --order 2", 0), Case("estimate decay.csv --method hilbert", 0))
"""Run first, so that no case pays for the imports."""
