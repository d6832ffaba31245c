"""Circles that touch three elements, to 50 digits, by a method of their own.

An element is a word and numbers: `P x y`, `C x y r`, `S x1 y1 x2 y2` (the line from the first point to the second), `M`
the same line, on which the centre lies, `A r` the radius. All of it in mm; senses by sign, as the language has them.
Each element is one linear equation in x, y, r and the power x²+y²−r²; three of them leave a pencil, and of that
come the circles. (The subroutine in examples/circles takes an origin of its own instead, and planes.)
"""

from __future__ import annotations

from dataclasses import dataclass

from mpmath import mp, mpf, sqrt, workdps

Element = tuple[str, *tuple[float, ...]]
Circle = tuple[mpf, mpf, mpf]

#: What is smaller than this, of numbers near 1, is nothing but rounding of 50 digits.
NOTHING = mpf(10) ** -30
#: A circle larger than this, in mm, is a line.
LINE = 1e5


def line(element: Element) -> tuple[mpf, mpf, mpf]:
    """Canonical form of the line from the first point to the second."""
    x1, y1, x2, y2 = map(mpf, element[1:])
    length = sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2)
    across, up = (y2 - y1) / length, (x1 - x2) / length
    return across, up, across * x1 + up * y1


def equation(element: Element) -> list[mpf]:
    """Coefficients of x, y, r, the power, and 1; their squares add up to 1."""
    kind, *numbers = element
    if kind in "PC":
        x, y, r = map(mpf, [*numbers, 0][:3])
        row = [-2 * x, -2 * y, 2 * r, mpf(1), x * x + y * y - r * r]
    elif kind == "A":
        row = [mpf(0), mpf(0), mpf(1), mpf(0), -mpf(numbers[0])]
    else:
        across, up, constant = line(element)
        row = [across, up, mpf(kind == "S"), mpf(0), -constant]
    norm = sqrt(sum(each * each for each in row))
    return [each / norm for each in row]


def product(u: list[mpf], v: list[mpf]) -> mpf:
    """The form that is 0 for a vector and itself where the vector is a circle."""
    return 2 * (u[0] * v[0] + u[1] * v[1] - u[2] * v[2]) - u[3] * v[4] - u[4] * v[3]


def pencil(elements: list[Element]) -> list[list[mpf]]:
    """Two vectors that solve the three equations; none when the equations are not independent."""
    rows, pivots = [equation(element) for element in elements], []
    for i in range(3):
        size, k, c = max((abs(rows[k][c]), k, c) for k in range(i, 3) for c in range(5) if c not in pivots)
        if size < NOTHING:
            return []
        rows[i], rows[k] = rows[k], rows[i]
        rows[i] = [each / rows[i][c] for each in rows[i]]
        pivots.append(c)
        for k in range(3):
            if k != i:
                rows[k] = [a - rows[k][c] * b for a, b in zip(rows[k], rows[i], strict=True)]
    found = []
    for free in set(range(5)) - set(pivots):
        vector = [mpf(c == free) for c in range(5)]
        for row, c in zip(rows, pivots, strict=True):
            vector[c] = -row[free]
        found.append(vector)
    return found


def solutions(elements: list[Element]) -> list[Circle] | None:
    """The circles, none of them a line; None when there is no end of them."""
    with workdps(50):
        vectors = pencil(elements)
        if not vectors:
            return None
        u, v = vectors
        a, b, c = product(u, u), product(u, v), product(v, v)
        if max(abs(a), abs(b), abs(c)) < NOTHING:
            return None
        under = b * b - a * c
        if under < -NOTHING:
            return []
        q = -b - (1 if b >= 0 else -1) * sqrt(max(under, mpf(0)))
        found: list[Circle] = []
        for s, t in ((q, a), (c, q)):
            if max(abs(s), abs(t)) ** 2 < NOTHING:  # that one is the other
                continue
            x, y, r, _, one = (s * each + t * other for each, other in zip(u, v, strict=True))
            if abs(one) * LINE > max(abs(x), abs(y), abs(r)):
                circle = (x / one, y / one, r / one)
                if all(apart(circle, other) > mpf(10) ** -12 for other in found):
                    found.append(circle)
        return found


def apart(one: Circle, other: Circle) -> mpf:
    """The largest difference of their numbers."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def miss(elements: list[Element], circle: Circle) -> mpf:
    """The largest distance of a circle from touching one of its elements in that one's direction, in mm."""
    x, y, r = circle
    worst = mpf(0)
    with workdps(50):
        for element in elements:
            kind, *numbers = element
            if kind in "PC":
                x1, y1, r1 = map(mpf, [*numbers, 0][:3])
                away = abs(sqrt((x - x1) ** 2 + (y - y1) ** 2) - abs(r - r1))
            elif kind == "A":
                away = abs(r - mpf(numbers[0]))
            else:
                across, up, constant = line(element)
                away = abs(across * x + up * y + (r if kind == "S" else 0) - constant)
            worst = max(worst, away)
    return worst


@dataclass(frozen=True)
class Asked:
    """An element as written in SKG, and the line of the subroutine that takes it."""

    statement: str
    entry: int


def asked(element: Element) -> Asked:
    kind, *numbers = element
    n = [mp.nstr(mpf(each), 12) for each in numbers]
    match kind:
        case "P":
            return Asked(f"P=({n[0]},{n[1]})", 810)
        case "C":
            return Asked(f"C=({n[0]},{n[1]}):{n[2]}", 820)
        case "A":
            return Asked(f"A={n[0]}", 850)
    return Asked(f"S=({n[0]},{n[1]}):({n[2]},{n[3]})", 830 if kind == "S" else 840)
