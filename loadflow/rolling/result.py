"""From the displacement of the inner ring to forces, safety, life and friction."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from loadflow.rolling.contact import Array, Contacts
from loadflow.rolling.equilibrium import RingEquilibrium


@dataclass(frozen=True)
class ContactResult(RingEquilibrium):
    """Equilibrium with what follows from each contact; quantities are formed when asked for.

    Attributes
    ----------
    contacts : Contacts
        The bearing's contacts, with the azimuth of each element.
    """

    contacts: Contacts

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        """Force and signed angle of each contact, (..., kind, element)."""
        from loadflow.rolling import _kernels

        q = self.displacement.reshape(-1, 5)
        shape = self.displacement.shape[:-1]
        force, angle = _kernels.contact_state(np.ascontiguousarray(q), *self.contacts.arguments)
        return force.reshape(*shape, *force.shape[1:]), angle.reshape(*shape, *angle.shape[1:])

    def _sums(self, *exponents: float) -> tuple[Array, Array]:
        """Largest force (..., kind) and sums of powers of the forces (..., kind, exponent).

        Formed in the compiled loop, without an array of all contact forces.
        """
        from loadflow.rolling import _kernels

        q = self.displacement.reshape(-1, 5)
        shape = self.displacement.shape[:-1]
        largest, sums = _kernels.force_sums(
            np.ascontiguousarray(q), *self.contacts.arguments, np.array(exponents, float)
        )
        return largest.reshape(*shape, -1), sums.reshape(*shape, *sums.shape[1:])
