"""What a kind of contact has to say: which keys it takes, what it builds of them, and what it is called.

A kind is one object of a class of this family, in a module of its own, and in `mgehl.kinds.KINDS`. How
an answer is found, stored and drawn depends on whether its contact `is_loaded`, never on its name.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Effort:
    """Work of runs of one sort, as it was measured."""

    convolutions: float
    """Those to be expected, in equivalents of one on the finest grid; half or twice as many are usual."""
    node_seconds: float
    """What a run takes besides for each convolution and node of the finest grid."""
    beside: float
    """Seconds that it takes besides for each convolution on however small a grid."""
    bytes_per_node: float
    measured: str
    counted: bool = True
    """False where a run makes no convolutions: the number then stands for its time alone."""
    most_bytes_per_node: float = 0.0
    """Where some runs need more: the most of them."""


class Kind:
    """A kind of contact; `config` is a `Config` of this kind throughout."""

    name: str
    """The value of contact.kind."""
    noun: str
    """As in "a point contact"."""
    about: str
    """A sentence for the head of a new configuration."""
    is_loaded: bool
    """True where bodies are pressed together by a load, False where the gap is given."""
    takes: tuple
    """Sections ("motion") and keys ("motion.speed") that it uses; any other one is a mistake."""
    essential: dict
    """Keys that a case is made of, with values that converge in seconds."""
    short: dict = {}
    """Keys whose values stand in titles without their name: functions from the value to a few words."""
    content = "Pressure and film of a lubricated"
    """What its fields are called: words before the noun."""
    cavitates = True
    """Whether its film tears where `discretization.cavitation` is not set."""

    def check_keys(self, config):
        """Raise ConfigError where values contradict each other."""

    def contact(self, config):
        """The contact, as the model has it."""
        raise NotImplementedError

    def with_domain(self, config, contact):
        """The `Config` with numbers in the place of "auto"."""
        return config

    def mesh(self, config, contact):
        """The finest mesh."""
        raise NotImplementedError

    def check(self, config, contact):
        """Raise ConfigError where values do not fit each other, though each is allowed."""

    def effort(self, config):
        """The `Effort` of such a run."""
        raise NotImplementedError

    def nodes(self, mesh, times="x"):
        """The nodes of a mesh in words."""
        return f"{mesh.nx} nodes" if mesh.is_line else f"{mesh.nx} {times} {mesh.ny} nodes"

    def lines(self, config, contact, mesh):
        """Lines of text that tell what was configured."""
        raise NotImplementedError

    def parts(self, solution):
        """The parts of a picture's title."""
        raise NotImplementedError

    def heading(self, solution):
        """The title of a page; numbers and their units stay together."""
        raise NotImplementedError

    def position_labels(self, contact):
        """What the axes along x and y show, with its unit."""
        raise NotImplementedError


def pressure_unit(GPa):
    """What turns a pressure, and all beside it, into its unit, and the unit: of a soft or light contact MPa
    or kPa."""
    return (1e6, "kPa") if GPa < 1e-4 else (1e3, "MPa") if GPa < 0.1 else (1.0, "GPa")


LONG_FILM = 1e-5
"""m from which on a film is told in um."""


def film_unit(film):
    """What turns a film in m into its unit, and the unit."""
    return (1e6, "um") if film >= LONG_FILM else (1e9, "nm")


def kept_together(text):
    """The text with spaces at which no line is broken."""
    return text.replace(" ", "\u00a0")
