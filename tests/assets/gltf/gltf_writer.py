"""Writes small glTF 2.0 files: accessors, meshes, nodes and animations in plain numbers."""
import json
import math
import struct
import zlib
from pathlib import Path

FOLDER = Path(__file__).parent
COMPONENTS = {"f": 5126, "B": 5121, "H": 5123}
WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


def as_float(value):
    """The nearest 32-bit float."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def turn(axis, degrees):
    """The quaternion x, y, z, w of a turn about axis 0, 1 or 2."""
    half = math.radians(degrees) / 2
    quaternion = [0.0, 0.0, 0.0, math.cos(half)]
    quaternion[axis] = math.sin(half)
    return quaternion


def png(rows):
    """An RGB picture of rows of pixels (r, g, b), stored without compression, so that every zlib writes the same."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    pixels = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels, 0)) +
            chunk(b"IEND", b""))


def pack(rows, component):
    return b"".join(struct.pack(f"<{len(row)}{component}", *row) for row in rows)


def box(half, center=(0, 0, 0)):
    """24 vertices of a box, four a side: positions, normals, texture coordinates, indices."""
    positions, normals, uv, indices = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(positions)
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis] = side * half[axis]
                corner[(axis + 1) % 3] = side * (2 * u - 1) * half[(axis + 1) % 3]
                corner[(axis + 2) % 3] = (2 * v - 1) * half[(axis + 2) % 3]
                positions.append([c + m for c, m in zip(corner, center)])
                normals.append([float(side * (axis == k)) for k in range(3)])
                uv.append([u, v])
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    return positions, normals, uv, indices


class Model:
    """A glTF document that grows. Methods return the index of what they added, primitive and box the primitive."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.binary = bytearray()

    def add(self, kind, **entry):
        self.json.setdefault(kind, []).append(entry)
        return len(self.json[kind]) - 1

    def view(self, data, **more):
        self.binary += bytes(-len(self.binary) % 4)
        offset = len(self.binary)
        self.binary += data
        return self.add("bufferViews", buffer=0, byteOffset=offset, byteLength=len(data), **more)

    def accessor(self, rows, component="f", bounds=False, **more):
        """Values in rows, numbers for scalars, in a view of their own."""
        rows = [row if isinstance(row, (list, tuple)) else [row] for row in rows]
        view = self.view(pack(rows, component))
        if bounds:
            columns = list(zip(*[[as_float(value) for value in row] for row in rows]))
            more |= {"min": [min(c) for c in columns], "max": [max(c) for c in columns]}
        return self.add("accessors", bufferView=view, componentType=COMPONENTS[component], count=len(rows),
                        type=WIDTHS[len(rows[0])], **more)

    def sparse(self, count, width, at, rows, base=None, **more):
        """`rows` replace the values `at` of the view `base`, of zeros without one."""
        if base is not None:
            more["bufferView"] = base
        return self.add("accessors", componentType=COMPONENTS["f"], count=count, type=WIDTHS[width], sparse={
            "count": len(at),
            "indices": {"bufferView": self.view(bytes(at)), "componentType": COMPONENTS["B"]},
            "values": {"bufferView": self.view(pack(rows, "f"))}}, **more)

    def primitive(self, positions, indices=None, material=None, targets=None, **attributes):
        """Attributes are rows of floats, or indices of accessors."""
        given = {"POSITION": self.accessor(positions, bounds=True)}
        for name, values in attributes.items():
            given[name] = values if isinstance(values, int) else self.accessor(values)
        entry = {"attributes": given}
        if indices:
            entry["indices"] = self.accessor(indices, "H")
        if material is not None:
            entry["material"] = material
        if targets:
            entry["targets"] = targets
        return entry

    def box(self, half, center=(0, 0, 0), material=None, textured=False, **more):
        """A primitive."""
        positions, normals, uv, indices = box(half, center)
        if textured:
            more["TEXCOORD_0"] = uv
        return self.primitive(positions, indices, material, NORMAL=normals, **more)

    def material(self, name, color, metallic=0.0, roughness=1.0, textures=None, **more):
        surface = {"baseColorFactor": [*color, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        return self.add("materials", name=name, pbrMetallicRoughness=surface | (textures or {}), **more)

    def node(self, name, parent=None, **more):
        index = self.add("nodes", name=name, **more)
        siblings = self.json["scenes"][0]["nodes"] if parent is None else self.json["nodes"][parent].setdefault(
            "children", [])
        siblings.append(index)
        return index

    def animate(self, name, *channels):
        """Channels: node, path, interpolation, times, rows of values."""
        samplers, targets = [], []
        for node, path, interpolation, times, rows in channels:
            samplers.append({"input": self.accessor(times, bounds=True),
                             "output": rows if isinstance(rows, int) else self.accessor(rows),
                             "interpolation": interpolation})
            targets.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})
        return self.add("animations", name=name, samplers=samplers, channels=targets)

    def extension(self, name):
        self.json.setdefault("extensionsUsed", []).append(name)

    def save(self, name):
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        if binary:
            self.json["buffers"] = [{"byteLength": len(binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942)
        data = struct.pack("<III", 0x46546C67, 2, 12 + len(chunks) + len(binary)) + chunks + binary
        (FOLDER / name).write_bytes(data)
