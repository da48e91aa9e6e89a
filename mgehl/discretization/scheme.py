"""How the Reynolds equation is differenced: every choice in one record."""

from dataclasses import dataclass

from mgehl.discretization.contact_law import ContactLaw, InterfaceConditions
from mgehl.discretization.couette import couette_scheme
from mgehl.discretization.fluid import FOLDING


@dataclass(frozen=True)
class Scheme:
    """Names of `couette.SCHEMES` and of `fluid.FACE_MOBILITIES`, and what happens beside contact."""

    couette: str = "1B"
    face_mobility: str = "arithmetic"
    mobility_share: float = 1.0
    """Part of that mean, the rest arithmetic: the way from the paper's mean to another."""
    couette_at_interface: str = "closed"
    """"closed" as [Liu eq. 4] asks, or "untreated": Poiseuille flow alone stops at contact."""
    motion: tuple[float, float] = (1.0, 0.0)
    """Velocity over the speed; (-1, 0): a wedge's plate, which moves against the differencing."""
    contact_law: ContactLaw = InterfaceConditions()
    """What happens where a gap closes."""
    coarsenings: int = 0
    """How many times coarser than the grid whose truncation error it is to have (`couette_scheme`)."""
    cavitation: bool = True
    """False lets the fluid's pressure be negative."""

    @property
    def is_oblique(self):
        """True where the surfaces move at an angle to both axes."""
        return self.motion[0] != 0.0 and self.motion[1] != 0.0

    @property
    def couette_flow(self):
        """The `CouetteScheme`. Where contact closes no faces no flow carries more away than there is."""
        scheme = couette_scheme(self.couette, self.coarsenings)
        return scheme if self.contact_law.closes_faces else scheme.limited()

    @property
    def mean(self):
        """All that decides how the mobility of a face follows from that of its nodes."""
        return self.face_mobility, self.mobility_share, self.contact_law

    @property
    def may_fold(self):
        """True where more pressure at a node may drive less flow out of it."""
        return self.face_mobility in FOLDING


INTERFACES = ("closed", "untreated")
