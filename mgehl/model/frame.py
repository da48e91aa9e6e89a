"""The axes in which a contact is solved: the user's, turned and mirrored until they suit the motion.

The surfaces move towards +X, and towards +Y by no more than towards +X: at an angle from 0 to 45 degrees.
Every other direction is that of a contact with its axes exchanged or mirrored, to the last bit. So the
lines of the smoother lie along the motion, as near as they can, and "upstream" has one meaning.
"""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np


@dataclass(frozen=True)
class Frame:
    """First x and y are mirrored, or not, then exchanged, or not. Points and arrays in, the same out."""

    mirrored_x: bool = False
    mirrored_y: bool = False
    exchanged: bool = False

    @classmethod
    def of(cls, angle):
        """The frame for a motion at an angle in degrees, from +x towards +y, and the angle in the frame."""
        angle = angle % 360.0
        mirrored_x, mirrored_y = 90.0 < angle < 270.0, angle > 180.0
        acute = min(angle % 180.0, 180.0 - angle % 180.0)
        exchanged = acute > 45.0
        return cls(mirrored_x, mirrored_y, exchanged), (90.0 - acute if exchanged else acute)

    def array(self, array):
        """The user's array (ny, nx) in this frame."""
        mirrored = self._mirrored(array)
        return np.ascontiguousarray(mirrored.T if self.exchanged else mirrored)

    def users_array(self, array):
        """The way back."""
        return np.ascontiguousarray(self._mirrored(array.T if self.exchanged else array))

    def _mirrored(self, array):
        return array[:: -1 if self.mirrored_y else 1, :: -1 if self.mirrored_x else 1]

    def angle(self, users):
        """The angle in this frame of the user's, both in degrees."""
        angle = 180.0 - users % 360.0 if self.mirrored_x else users % 360.0
        if self.mirrored_y:
            angle = -angle if angle < 180.0 else 360.0 - angle
        return 90.0 - angle if self.exchanged else angle

    def vector(self, x, y):
        """The parts along X and Y of a vector whose parts along the user's x and y these are."""
        return self.pair(-x if self.mirrored_x else x, -y if self.mirrored_y else y)

    def users_point(self, x, y):
        """The user's x and y of a point in this frame."""
        x, y = (y, x) if self.exchanged else (x, y)
        return (-x if self.mirrored_x else x), (-y if self.mirrored_y else y)

    def pair(self, x, y):
        """What belongs to the user's x and to his y, as it belongs to X and Y here."""
        return (y, x) if self.exchanged else (x, y)

    def intervals(self, x, y):
        """The user's intervals of x and y in this frame."""
        return self.pair(_mirrored(x) if self.mirrored_x else x, _mirrored(y) if self.mirrored_y else y)

    def users_node(self, i, j, nx, ny):
        """The user's numbers of node (i, j), both from 1, of nx by ny nodes here."""
        (i, nx), (j, ny) = self.pair((i, nx), (j, ny))
        return (nx + 1 - i if self.mirrored_x else i), (ny + 1 - j if self.mirrored_y else j)

    def users_ranges(self, along_X, along_Y, nx, ny):
        """First and last node along X and along Y, from 1, or None, as the user counts them."""
        (x, nx), (y, ny) = self.pair((along_X, nx), (along_Y, ny))
        if x and self.mirrored_x:
            x = nx + 1 - x[1], nx + 1 - x[0]
        if y and self.mirrored_y:
            y = ny + 1 - y[1], ny + 1 - y[0]
        return x, y

    def users_sides(self, west, east, before, after):
        """What belongs to the four sides of a node here, as it belongs to the user's."""
        (west, east), (before, after) = self.pair((west, east), (before, after))
        x = (east, west) if self.mirrored_x else (west, east)
        y = (after, before) if self.mirrored_y else (before, after)
        return *x, *y


@dataclass(frozen=True)
class SurfaceInFrame:
    """A surface whose heights are known in the user's axes."""

    surface: object
    frame: Frame

    def height(self, x, y):
        """Height in m at `x` and `y` in m of the frame."""
        return self.surface.height(*self.frame.users_point(x, y))

    def shortest(self, x, y):
        """Shortest wavelength in m, seen on nodes x (nx,) and y (ny,) of the frame."""
        return self.surface.shortest(*self._users_lines(x, y))

    def filtered(self, wavelengths, x, y):
        """Without shorter waves than those along the frame's x and y, in m."""
        wavelengths = self.frame.pair(*wavelengths)
        filtered = self.surface.filtered(wavelengths, *self._users_lines(x, y))
        return SurfaceInFrame(filtered, self.frame)

    @property
    def moving(self):
        """Parts that move, as of a `Surface`."""
        return tuple((body, SurfaceInFrame(part, self.frame)) for body, part in self.surface.moving)

    def _users_lines(self, x, y):
        return [np.sort(line) for line in self.frame.users_point(x, y)]


def direction(angle):
    """Parts along x and y of a unit vector at an angle in degrees; 90 degrees and the like are exact."""
    frame, acute = Frame.of(angle)
    parts = frame.pair(cos(radians(acute)), sin(radians(acute)))
    return (-parts[0] if frame.mirrored_x else parts[0]), (-parts[1] if frame.mirrored_y else parts[1])


def _mirrored(interval):
    return -interval[1], -interval[0]
