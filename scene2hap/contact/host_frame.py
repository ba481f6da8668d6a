"""Guest and host of a pair, and the guest's box in the host's frame.

Written in plain Python, since it runs often for one pair at a time, where numpy's cost per call would dominate.
"""

from __future__ import annotations

from scene2hap.contact.body import Body
from scene2hap.contact.geometry.vectors import Triple


def middle_m(body: Body) -> Triple:
    """Return the middle of a body's oriented box in the world [m]."""
    (mx, my, mz), (x, y, z), ((a, b, c), (d, e, f), (g, h, i)) = body.shape.middle, body.position_m, body.stance.rows
    return (x + a * mx + b * my + c * mz, y + d * mx + e * my + f * mz, z + g * mx + h * my + i * mz)


def roles(x: Body, y: Body) -> tuple[Body, Body]:
    """Return guest and host, the smaller and the larger body; ids decide between equal sizes."""
    return (x, y) if (x.size_m, y.id) < (y.size_m, x.id) else (y, x)


def box_in_frame(guest: Body, host: Body) -> tuple[Triple, Triple]:
    """Return middle and half edges [m], along the host's axes, of a box around the guest's oriented box."""
    (x, y, z), (u, v, w), (p, q, r) = middle_m(guest), host.position_m, guest.shape.half
    x, y, z = x - u, y - v, z - w
    (a, b, c), (d, e, f), (g, h, i) = guest.stance.rows
    (j, k, ll), (m, n, o), (s, t, u) = host.stance.rows
    return (
        (j * x + m * y + s * z, k * x + n * y + t * z, ll * x + o * y + u * z),
        (
            abs(j * a + m * d + s * g) * p + abs(j * b + m * e + s * h) * q + abs(j * c + m * f + s * i) * r,
            abs(k * a + n * d + t * g) * p + abs(k * b + n * e + t * h) * q + abs(k * c + n * f + t * i) * r,
            abs(ll * a + o * d + u * g) * p + abs(ll * b + o * e + u * h) * q + abs(ll * c + o * f + u * i) * r,
        ),
    )
