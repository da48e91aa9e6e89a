"""What a public code finds of study dry's contacts: ContactMechanics 1.8.3 [Polonsky and Keer 1999].

The same discretisation: uniform pressure on rectangles around nodes, no periods.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Reference:
    """Nodes in contact, largest pressure in GPa, approach in um."""

    contact_nodes: int
    max_pressure: float
    approach: float


@dataclass(frozen=True)
class PublicWork:
    """Convolutions and seconds of one processor, tolerances as the code has them by default."""

    convolutions: int
    cpu: float


REFERENCE = {
    ("smooth", 129): Reference(5393, 2.263137, 13.289746),
    ("smooth", 257): Reference(21523, 2.263097, 13.290003),
    ("wavy 50 nm", 129): Reference(5403, 2.383120, 13.291814),
    ("wavy 50 nm", 257): Reference(21545, 2.382500, 13.292027),
    ("wavy 200 nm", 129): Reference(5409, 2.742123, 13.292494),
    ("wavy 200 nm", 257): Reference(21607, 2.739792, 13.292674),
    ("wavy 1 um", 129): Reference(4399, 4.630775, 13.158939),
    ("wavy 1 um", 257): Reference(17409, 4.619498, 13.159511),
    ("ridge 200 nm", 129): Reference(5421, 2.599292, 13.281467),
    ("ridge 200 nm", 257): Reference(21691, 2.598336, 13.281677),
    ("rough 50 nm", 129): Reference(5377, 2.733334, 13.287733),
    ("rough 50 nm", 257): Reference(21429, 2.734929, 13.287958),
    ("rough 200 nm", 129): Reference(5042, 4.401195, 13.257591),
    ("rough 200 nm", 257): Reference(20097, 4.384155, 13.258240),
    ("rough 500 nm", 129): Reference(3688, 7.651524, 13.096869),
    ("rough 500 nm", 257): Reference(14486, 7.602938, 13.098811),
}
"""By surface and nodes a side: runs of the public code to its last digits."""

WORK = {
    ("smooth", 129): PublicWork(50, 0.35),
    ("wavy 50 nm", 129): PublicWork(54, 0.25),
    ("wavy 200 nm", 129): PublicWork(52, 0.19),
    ("wavy 1 um", 129): PublicWork(60, 0.26),
    ("ridge 200 nm", 129): PublicWork(46, 0.16),
    ("rough 50 nm", 129): PublicWork(54, 0.25),
    ("rough 200 nm", 129): PublicWork(62, 0.28),
    ("rough 500 nm", 129): PublicWork(96, 0.46),
    ("smooth", 257): PublicWork(54, 2.01),
    ("wavy 50 nm", 257): PublicWork(60, 2.55),
    ("wavy 200 nm", 257): PublicWork(60, 2.25),
    ("wavy 1 um", 257): PublicWork(74, 2.85),
    ("ridge 200 nm", 257): PublicWork(52, 2.03),
    ("rough 50 nm", 257): PublicWork(62, 2.17),
    ("rough 200 nm", 257): PublicWork(116, 4.72),
    ("rough 500 nm", 257): PublicWork(180, 6.59),
}
"""By surface and nodes a side, measured on the machine that wrote runs/tables/dry.md."""
