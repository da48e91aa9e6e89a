"""How the Reynolds equation is differenced: every choice in one record."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Scheme:
    """Names of `couette.SCHEMES` and `fluid.FACE_MEANS`, and what happens beside contact."""

    couette: str = "1B"
    face_mobility: str = "arithmetic"
    mobility_share: float = 1.0
    """Part of that mean, the rest arithmetic: the way from the paper's mean to another."""
    couette_at_interface: str = "closed"
    """"closed" as [Liu eq. 4] asks, or "untreated": Poiseuille flow alone stops at contact."""
    motion: int = 1
    """+1 where the surfaces move towards +X, with the differencing; -1 where they move against it."""
    gap_floor: float | None = None
    """Smallest gap of the Poiseuille flow in the unified equations; None with interface conditions."""
    cavitation: bool = True
    """False lets the fluid's pressure be negative."""


INTERFACES = ("closed", "untreated")
