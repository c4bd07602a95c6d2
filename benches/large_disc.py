"""A disc and a pad of ten-node tetrahedra of any size, for timings of `frictionsim cea`.

    python3 benches/large_disc.py UNKNOWNS FOLDER        # writes FOLDER/disc.inp and FOLDER/disc.toml

The disc (steel, 30 to 75 mm, 12 mm thick, clamped at its bore) and the pad (a friction material with its own damping, held
across the pressure) are cut into bricks, of about two millimetres at half a million unknowns, and these into six
tetrahedra each. Their meshes do not match in the contact, which opens in part: `state = "closed"` in
`[contacts.Pad_Face]` keeps it shut.
"""

import math
import sys

# Corners of the six tetrahedra of a brick, all around the diagonal from corner 0 to corner 7 (bits: x, y, z).
TETRAHEDRA = [[0, a, a | b, 7] for a in (1, 2, 4) for b in (1, 2, 4) if a != b]
# Corners whose middle is a node, in the order of C3D10.
EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
# Corners of faces S1 to S4.
FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]

CASE = """title = "Disc and pad of ten-node tetrahedra"

[mesh]
file = "disc.inp"

[cea]
friction_coefficients = { from = 0.0, to = 0.6, count = 20 }
modes = 30
"""


class Part:
    """A part of a ring in cylindrical bricks: counts and lengths along radius, angle and axis."""

    def __init__(self, name, counts, radii, angles, heights):
        self.name, self.counts = name, [2 * count for count in counts]
        self.spans, self.is_ring = (radii, angles, heights), angles[1] - angles[0] > 6.28
        self.number, self.points, self.elements = {}, [], []
        for brick in ((i, j, k) for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])):
            for corners in TETRAHEDRA:
                places = [tuple(2 * (brick[a] + (corner >> a & 1)) for a in range(3)) for corner in corners]
                if self.volume(places) < 0:
                    places[1], places[2] = places[2], places[1]
                middle = [tuple((a + b) // 2 for a, b in zip(places[i], places[j])) for i, j in EDGES]
                self.elements.append((places, [self.node(place) for place in places + middle]))

    def volume(self, p):
        """Six times that of a tetrahedron in (radius, angle, axis), a right-handed system."""
        a, b, c = [[p[k][i] - p[0][i] for i in range(3)] for k in (1, 2, 3)]
        return sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))

    def node(self, place):
        """Number of the node at half steps along radius, angle and axis."""
        if self.is_ring:
            place = (place[0], place[1] % self.counts[1], place[2])
        if place not in self.number:
            r, t, z = [low + (high - low) * at / count
                       for (low, high), at, count in zip(self.spans, place, self.counts)]
            self.points.append((r * math.cos(t), r * math.sin(t), z))
            self.number[place] = len(self.points)
        return self.number[place]

    def faces(self, axis, at):
        """Elements and faces that lie where a coordinate is `at`, in half steps."""
        for number, (places, _) in enumerate(self.elements, 1):
            for face, corners in enumerate(FACES, 1):
                if all(places[c][axis] == at for c in corners):
                    yield f"{number}, S{face}"

    def write(self, out, surfaces, sets):
        rows = [f"*Part, name={self.name}", "*Node"]
        rows += [f"{i}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(self.points, 1)]
        rows.append("*Element, type=C3D10, elset=All")
        rows += [f"{i}, {', '.join(map(str, nodes))}" for i, (_, nodes) in enumerate(self.elements, 1)]
        for name, axis, at in sets:
            rows.append(f"*Nset, nset={name}")
            rows += [str(number) for place, number in self.number.items() if at in (None, place[axis])]
        for name, axis, at in surfaces:
            rows.append(f"*Surface, type=ELEMENT, name={name}")
            rows += self.faces(axis, at)
        rows += [f"*Solid Section, elset=All, material={self.name}", "*End Part"]
        out.write("\n".join(rows) + "\n")


def main():
    unknowns, folder = float(sys.argv[1]), sys.argv[2]
    size = (5e5 / unknowns) ** (1 / 3)  # Of a brick, beside that at half a million.

    def count(at_half_a_million):
        return max(1, round(at_half_a_million / size))

    disc = Part("Disc", (count(19), count(208), count(5)), (0.03, 0.075), (0, 2 * math.pi), (0, 0.012))
    pad = Part("Pad", (count(12), count(29), count(4)), (0.042, 0.072), (0.1, 1.0), (0.012, 0.021))
    with open(f"{folder}/disc.inp", "w", encoding="ascii") as out:
        out.write("*Heading\nDisc and pad of ten-node tetrahedra\n")
        disc.write(out, [("Top", 2, disc.counts[2])], [("Bore", 0, 0), ("All", 0, None)])
        pad.write(out, [("Face", 2, 0), ("Back", 2, pad.counts[2])], [("Plate", 2, pad.counts[2])])
        out.write("""*Assembly, name=Brake
*Instance, name=Disc, part=Disc
*End Instance
*Instance, name=Pad, part=Pad
*End Instance
*End Assembly
*Material, name=Disc
*Density
7850.,
*Elastic
2.1e11, 0.3
*Damping, alpha=10., beta=1e-9
*Material, name=Pad
*Density
2600.,
*Elastic
8e9, 0.25
*Damping, beta=2e-7
*Surface Interaction, name=Rubbing
*Friction
0.4,
*Surface Behavior, pressure-overclosure=LINEAR
1e13,
*Contact Pair, interaction=Rubbing, type=SURFACE TO SURFACE
Pad.Face, Disc.Top
*Boundary
Disc.Bore, ENCASTRE
Pad.Plate, 1, 2
*Step, name=Press
*Static
*Dsload
Pad.Back, P, 1e6
*End Step
*Step, name=Turn
*Static
*Motion, rotation
Disc.All, 10.0, 0., 0., 0., 0., 0., 1.
*End Step
""")
    with open(f"{folder}/disc.toml", "w", encoding="utf-8") as out:
        out.write(CASE)
    print(f"{3 * (len(disc.points) + len(pad.points))} dofs")


main()
