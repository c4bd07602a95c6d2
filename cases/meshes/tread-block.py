"""Writes tread-block.msh, a block of bricks in millimetres: python3 tread-block.py"""

SIZE, COUNTS = (30.0, 18.0, 10.0), (10, 6, 4)  # along the sliding, across it, height


def node(i, j, k):
    return 1 + i + (COUNTS[0] + 1) * (j + (COUNTS[1] + 1) * k)


def ring(i, j, k):
    return [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]


nodes = [
    [size * place / count for size, place, count in zip(SIZE, (i, j, k), COUNTS)]
    for k in range(COUNTS[2] + 1)
    for j in range(COUNTS[1] + 1)
    for i in range(COUNTS[0] + 1)
]
columns = [(i, j) for j in range(COUNTS[1]) for i in range(COUNTS[0])]
elements = [(3, 1, ring(i, j, 0)) for i, j in columns]
elements += [(3, 2, ring(i, j, COUNTS[2])) for i, j in columns]
elements += [(5, 3, ring(i, j, k) + ring(i, j, k + 1)) for k in range(COUNTS[2]) for i, j in columns]
with open("tread-block.msh", "w", encoding="ascii") as mesh:
    mesh.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
    mesh.write('$PhysicalNames\n3\n2 1 "floor"\n2 2 "carcass"\n3 3 "block"\n$EndPhysicalNames\n')
    mesh.write(f"$Nodes\n{len(nodes)}\n")
    for number, place in enumerate(nodes, 1):
        mesh.write(" ".join(f"{x:g}" for x in [number, *place]) + "\n")
    mesh.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
    for number, (kind, group, own) in enumerate(elements, 1):
        mesh.write(" ".join(map(str, [number, kind, 2, group, group, *own])) + "\n")
    mesh.write("$EndElements\n")
