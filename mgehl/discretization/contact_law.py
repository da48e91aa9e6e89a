"""What happens where a gap closes: the laws of contact that a run may choose between."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np


@dataclass(frozen=True)
class ContactLaw(ABC):
    """How small gaps let fluid through, and when they are closed; gaps in units of H."""

    thinnest: float = 0.0
    """The thinnest film that a law knows, 0 where it names none."""

    words: ClassVar[str]
    """How contact closes, in a few words after "contact"."""
    has_contact: ClassVar[bool]
    """Whether bodies touch: without it no node is ever in contact, and bodies may overlap."""
    closes_faces = True
    """Whether contact closes its faces; where it does not, its pressure and its flow say when it opens."""
    contact_gap = 0.0
    """The gap that bodies in contact keep."""

    @property
    def is_continuous(self):
        """Whether bodies touch, and a film closes as continuously as it opens."""
        return self.has_contact and not self.closes_faces

    @abstractmethod
    def flow_gap(self, H):
        """The gap that the Poiseuille flow sees, and its derivative by H."""

    def carried(self, H):
        """The part of the gap that the surfaces carry along as fluid; its derivative by H is 1."""
        return H

    @abstractmethod
    def closed(self, H, was_released):
        """Where fluid of gap H comes into contact; `was_released` of nodes that contact let go before."""

    @abstractmethod
    def takes_fluid(self, H):
        """Where a cavity of gap H may fill with fluid."""


@dataclass(frozen=True)
class InterfaceConditions(ContactLaw):
    """The lubrication-contact interface conditions: contact where the gap is closed, which it is below
    H_th, the thinnest film  [Liu eqs. 2, 4]."""

    words = "closes its faces at once"
    has_contact = True

    def flow_gap(self, H):
        return H, 1.0

    def closed(self, H, was_released):
        """Below H_th; a node that was let go comes back only when the bodies would overlap. With a gap
        between 0 and H_th it would be torn off and put back for ever."""
        return np.where(was_released, 0.0, self.thinnest) >= H

    def takes_fluid(self, H):
        """A node without a gap cannot take part in the flow."""
        return H > 0.0


@dataclass(frozen=True)
class BoundaryFilm(ContactLaw):
    """Contact where the film would be thinner than the layers that bodies keep between them: H - h_b >= 0
    and P - p >= 0, one of them zero; h_b is the thinnest film. P is what the bodies feel, p the fluid's own
    pressure, which answers to the flow through a film of h_b. So Eq. 2 holds; with h_b the flow goes to
    nothing [Liu eq. 4]."""

    words = "closes continuously, on layers that leak as their thickness says"
    has_contact = True
    closes_faces = False

    leaks: bool = True
    """Whether there are layers that fluid flows through; else h_b is the film at which bodies touch."""

    def flow_gap(self, H):
        return np.maximum(H, self.thinnest), H > self.thinnest

    def carried(self, H):
        """What lies above the layers: they stick and are not compressed. As fluid they would thicken
        wherever the pressure falls along the motion: no contact's rear half could stay."""
        return H - self.thinnest

    def closed(self, H, was_released):
        return self.thinnest >= H

    def takes_fluid(self, H):
        return H >= self.thinnest

    @property
    def contact_gap(self):
        return self.thinnest


@dataclass(frozen=True)
class UnifiedEquations(ContactLaw):
    """Reynolds' equation everywhere, no interface conditions; its Poiseuille flow has a smallest gap, the
    thinnest film."""

    words = "has no place in the unified equations: bodies may overlap"
    has_contact = False

    def flow_gap(self, H):
        return np.maximum(H, self.thinnest), H > self.thinnest

    def closed(self, H, was_released):
        return np.zeros(np.shape(H), dtype=bool)

    def takes_fluid(self, H):
        return np.ones(np.shape(H), dtype=bool)
