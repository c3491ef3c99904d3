"""What a motion is, beside its omega0(t): its energy, its components a_m(t), and what its sampling folds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import relative
from ridgeback.common.quantities import frequency
from ridgeback.common.show.brief import Brief
from ridgeback.compare.motion.harmonics.components import Components, components
from ridgeback.compare.motion.harmonics.folding import Folding, folded_sentence
from ridgeback.compare.motion.harmonics.order_analysis import orders
from ridgeback.compare.motion.harmonics.overtones import folding_of
from ridgeback.compare.motion.motion import Motion
from ridgeback.numeric.orbits.energy import EnergyTerms, energy_terms


@dataclass(frozen=True, repr=False)
class Account(Brief):
    """Energy, components and sampling of one motion."""

    energy: EnergyTerms | None
    """None without a potential."""
    components: Components
    folding: Folding
    time_unit: str

    def sentences(self) -> Iterator[str]:
        """One sentence each."""
        if self.energy is not None:
            yield energy_sentence(self.energy)
        yield self.components.headline()
        yield folded_sentence(self.folding, lambda omega: frequency(omega, self.time_unit), self.time_unit)

    def to_dict(self) -> dict[str, object]:
        """The energy at the start, what of it is lost and how the balance closes; components by cycle; folding."""
        energy = None if self.energy is None else energy_summary(self.energy)
        return {
            "energy": energy,
            "components": self.components.rows(),
            "components_model_error": self.components.model_error,
            "folded_multiples": self.folding.folded,
            "whole_multiples": self.folding.whole,
            "rates_that_fold_the_two_highest": self.folding.two_fold,
        }


def energy_summary(terms: EnergyTerms) -> dict[str, float]:
    """The energy balance in four numbers, per unit of mass and counted from the bottom of the well."""
    at_start = -float(terms.potential.min()) + float(terms.kinetic[0])
    return {
        "at_start": at_start,
        "dissipated": float(terms.dissipated[-1]),
        "largest_imbalance": float(np.abs(terms.balance).max()),
        "relative_imbalance": float(np.abs(terms.balance).max()) / at_start,
    }


def energy_sentence(terms: EnergyTerms) -> str:
    """How the balance closes."""
    found = energy_summary(terms)
    lost = relative(found["dissipated"] / found["at_start"])
    open_by = relative(found["relative_imbalance"])
    return f"Energy: {lost} of that at the start is dissipated; the balance closes within {open_by} of it."


def account(motion: Motion) -> Account:
    """Energy, components and sampling of a motion."""
    run = motion.trajectory
    return Account(
        energy=energy_terms(motion.dynamics, run) if motion.has_backbone else None,
        components=components(motion),
        folding=folding_of(motion, orders(lambda t: run.at(t)[1], motion.rising)),
        time_unit=motion.setting.time_unit,
    )
