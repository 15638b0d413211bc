#!/usr/bin/env python3
"""Writes a simpler copy of the meshes of a GLB file, as a file for `gnomon --proxies`.

Vertices in one cell of a grid become one, at their mean; triangles that lose a side are dropped.
Based on: Rossignac, Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993.
"""
import argparse
import json
import math
import struct
import sys

TYPES = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}


def read_glb(file):
    data = open(file, "rb").read()
    if data[:4] != b"glTF":
        sys.exit(f"{file}: is no GLB file")
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def values(gltf, binary, index, width):
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    kind, size = TYPES[accessor["componentType"]]
    step = view.get("byteStride", size * width)
    first = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return [struct.unpack_from(f"<{width}{kind}", binary, first + i * step) for i in range(accessor["count"])]


def clustered(positions, triangles, cell, grow):
    cells = {}
    of_vertex = []
    for p in positions:
        key = tuple(math.floor(c / cell) for c in p)
        of_vertex.append(cells.setdefault(key, len(cells)))
    sums = [[0.0, 0.0, 0.0, 0] for _ in cells]
    for p, c in zip(positions, of_vertex):
        for i in range(3):
            sums[c][i] += p[i]
        sums[c][3] += 1
    means = [[s[i] / s[3] for i in range(3)] for s in sums]
    middle = [sum(m[i] for m in means) / len(means) for i in range(3)]
    grown = [[middle[i] + grow * (m[i] - middle[i]) for i in range(3)] for m in means]
    moved = [tuple(of_vertex[corner] for corner in triangle) for triangle in triangles]
    # A wall and what stands out of it may have become one.
    once = {frozenset(t): t for t in moved if len(set(t)) == 3}
    return grown, list(once.values())


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("source", help="GLB file with triangles, as gnomon scenes --write writes")
    arguments.add_argument("target", help="GLB file to write")
    arguments.add_argument("--mesh", action="append", required=True, help="begin of the names of meshes; may be repeated")
    arguments.add_argument("--cell", type=float, required=True, help="side of a cell, in the mesh's own units")
    arguments.add_argument("--grow", type=float, default=1.0, help="size of the copy, of the original's")
    words = arguments.parse_args()
    gltf, binary = read_glb(words.source)
    out = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
           "accessors": [], "bufferViews": [], "buffers": []}
    bytes_out = bytearray()

    def add(kind, component, items, more):
        flat = [v for item in items for v in item]
        out["bufferViews"].append({"buffer": 0, "byteOffset": len(bytes_out), "byteLength": 4 * len(flat)})
        bytes_out.extend(struct.pack("<%d%s" % (len(flat), TYPES[component][0]), *flat))
        out["accessors"].append({"bufferView": len(out["bufferViews"]) - 1, "componentType": component,
                                 "type": kind, **more})
        return len(out["accessors"]) - 1

    for mesh in gltf["meshes"]:
        if not any(mesh.get("name", "").startswith(name) for name in words.mesh):
            continue
        primitives, before, after = [], 0, 0
        for primitive in mesh["primitives"]:
            positions = values(gltf, binary, primitive["attributes"]["POSITION"], 3)
            indices = [i for (i,) in values(gltf, binary, primitive["indices"], 1)]
            triangles = list(zip(indices[0::3], indices[1::3], indices[2::3]))
            simple, kept = clustered(positions, triangles, words.cell, words.grow)
            before, after = before + len(triangles), after + len(kept)
            if not kept:
                continue
            low, high = [[f(p[i] for p in simple) for i in range(3)] for f in (min, max)]
            primitives.append({
                "attributes": {"POSITION": add("VEC3", 5126, simple, {"count": len(simple), "min": low, "max": high})},
                "indices": add("SCALAR", 5125, kept, {"count": 3 * len(kept)})})
        if not primitives:
            sys.exit(f"{mesh['name']}: cells of {words.cell} leave no triangle")
        print(f"{mesh['name']}: {before} triangles, {after} in its copy")
        out["meshes"].append({"name": mesh["name"], "primitives": primitives})
        out["nodes"].append({"mesh": len(out["meshes"]) - 1})
        out["scenes"][0]["nodes"].append(len(out["nodes"]) - 1)
    if not out["meshes"]:
        sys.exit(f"{words.source}: no mesh is called {' or '.join(words.mesh)}")
    out["buffers"] = [{"byteLength": len(bytes_out)}]
    text = json.dumps(out).encode()
    text += b" " * (-len(text) % 4)
    with open(words.target, "wb") as file:
        file.write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(bytes_out), len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(bytes_out), 0x004E4942) + bytes_out)


main()
