"""Files of glTF 2.0 as `chasles.gltf` needs them: the JSON, the bytes of its buffers, numbers of accessors, and a GLB of all of it.

Source: Khronos Group, "glTF 2.0 Specification", sections 3.6 (binary data) and 4 (GLB).
"""

from __future__ import annotations

import base64
import binascii
import json
import os
import pathlib
import struct
import urllib.parse
from functools import cached_property
from typing import Any, TypeGuard

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput
from .read_file import read_file

Array = npt.NDArray[np.float64]
Json = dict[str, Any]

MOST_JSON = 1 << 28  # bytes
MOST_BYTES = 1 << 31  # of all buffers together: a GLB has 32 bits for them
MOST_SPARSE = 1 << 20  # elements of an accessor without bytes of its own, as for meshes
LARGEST = 1e30  # number of a transform
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
TYPES: dict[int, Any] = {
    5120: np.int8,
    5121: np.uint8,
    5122: np.int16,
    5123: np.uint16,
    5125: np.uint32,
    5126: np.float32,
}
COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


class Document:
    """One file, which is read once: it may be a pipe. All that is wrong with it raises InvalidInput with the name of the file in front."""

    def __init__(self, path: str | os.PathLike[str]):
        self.path = pathlib.Path(path)
        data = self._bytes_of(self.path)
        text, self._binary = self._chunks(data) if data[:4] == b"glTF" else (data, None)
        self.json = self._parsed(text)
        self._buffers: dict[int, bytes] = {}
        self._items: dict[str, list[Json]] = {}
        self.files = {self.path}  #: all files that were read
        version = self.json.get("asset", {}).get("version") if isinstance(self.json.get("asset"), dict) else None
        if not isinstance(version, str):
            raise self.fault("is no glTF: has no asset with a version")
        if not version.startswith("2."):
            raise self.fault(f"is glTF {version[:20]}; only glTF 2 is read")

    def fault(self, why: str) -> InvalidInput:
        """The error to raise."""
        return InvalidInput(f"{self.path}: {why}")

    def items(self, kind: str) -> list[Json]:
        """The objects of a list of the file, as "nodes"."""
        if kind not in self._items:
            self._items[kind] = self.objects(self.json, kind, "")
        return self._items[kind]

    @cached_property
    def markers(self) -> frozenset[int]:
        """The nodes that `chasles.gltf.mark` made. They stand for contacts, and are no bodies."""
        return frozenset(index for index, node in enumerate(self.items("nodes")) if _is_marker(node))

    def item(self, kind: str, index: Any, where: str) -> Json:
        """The object with an index that `where` states."""
        items = self.items(kind)
        if not is_index(index) or index >= len(items):
            raise self.fault(f"{where}: there is no {kind[:-1]} {str(index)[:40]}")
        return items[int(index)]

    def count(self, item: Json, key: str, where: str, default: int | None = None) -> int:
        """A number that counts or is an index."""
        value = item.get(key, default)
        if not is_index(value):
            raise self.fault(f"{where}: {key}: must be an integer from 0 on")
        return int(value)

    def objects(self, item: Json, key: str, where: str) -> list[Json]:
        """The objects of a list within another object."""
        found = item.get(key, [])
        if not isinstance(found, list) or not all(isinstance(entry, dict) for entry in found):
            raise self.fault(f"{where}: {key}: must be a list of objects".removeprefix(": "))
        return found

    def numbers(self, index: Any, kind: str, where: str) -> Array:
        """The numbers (count, components) of the accessor, which `where` states."""
        item = self.item("accessors", index, where)
        place = f"accessor {index}"
        if item.get("type") != kind:
            raise self.fault(f"{place}: type: must be {kind}, not {str(item.get('type'))[:20]}")
        count = self.count(item, "count", place)
        if "bufferView" in item:
            found = self._copied(item, item, count, COMPONENTS[kind], place)
        elif "sparse" not in item or count > MOST_SPARSE:
            raise self.fault(f"{place}: announces {count} elements, but has no bufferView")
        else:
            found = np.zeros((count, COMPONENTS[kind]))
        if "sparse" in item:
            self._add_sparse(item, found, place)
        if not (np.abs(found) < LARGEST).all():  # NaN, too
            raise self.fault(f"{place}: NaN, infinity or a number beyond {LARGEST:g}")
        return found

    def as_glb(self, changed: Json | None = None, more: bytes = b"") -> bytes:
        """The file as one GLB, with the buffers in one and `more` behind them; `changed` in the place of its JSON.

        The offset of `more` is `len(self.binary)`.
        """
        result = dict(self.json if changed is None else changed)
        binary = self.binary + more  # refuses too many bytes
        starts = self._starts()
        self.items("bufferViews")
        result["bufferViews"] = [self._moved(view, i, starts) for i, view in enumerate(result.get("bufferViews", []))]
        result["buffers"] = [{"byteLength": len(binary)}]
        for key in ("bufferViews", "buffers"):
            if not binary:
                result.pop(key)
        text = json.dumps(result, ensure_ascii=False, separators=(",", ":")).encode()
        parts = [_chunk(JSON_CHUNK, text, b" ")] + ([_chunk(BINARY_CHUNK, binary, b"\0")] if binary else [])
        return struct.pack("<4sII", b"glTF", 2, 12 + sum(map(len, parts))) + b"".join(parts)

    @property
    def binary(self) -> bytes:
        """All buffers one behind the other, each at a multiple of four."""
        sizes = [self.count(item, "byteLength", f"buffer {i}") for i, item in enumerate(self.items("buffers"))]
        if sum(sizes) > MOST_BYTES:
            raise self.fault(f"its buffers have {sum(sizes)} bytes; at most {MOST_BYTES} are read")
        return b"".join(_padded(self._buffer(i), b"\0") for i in range(len(self.items("buffers"))))

    def _starts(self) -> dict[int, int]:
        sizes = [len(_padded(self._buffer(i), b"\0")) for i in range(len(self.items("buffers")))]
        return {i: int(sum(sizes[:i])) for i in range(max(len(sizes), 1))}

    def _moved(self, view: Json, index: int, starts: dict[int, int]) -> Json:
        place = f"bufferView {index}"
        start = starts.get(self.count(view, "buffer", place))
        if start is None:
            raise self.fault(f"{place}: there is no buffer {view['buffer']}")
        return {**view, "buffer": 0, "byteOffset": self.count(view, "byteOffset", place, 0) + start}

    def _bytes_of(self, path: pathlib.Path) -> bytes:
        try:
            return read_file(path)
        except InvalidInput:
            raise
        except (OSError, ValueError) as error:
            raise self.fault(f"cannot read {path.name}: {getattr(error, 'strerror', None) or error}") from None

    def _chunks(self, data: bytes) -> tuple[bytes, bytes | None]:
        if len(data) >= 8 and (version := struct.unpack_from("<I", data, 4)[0]) != 2:
            raise self.fault(f"is GLB of version {version}; only version 2 is read")
        if len(data) < 20 or (length := struct.unpack_from("<I", data, 8)[0]) > len(data):
            raise self.fault("is truncated: the file is shorter than its header announces")
        chunks: dict[int, bytes] = {}
        at = 12
        while at + 8 <= length:
            size, kind = struct.unpack_from("<II", data, at)
            if size > length - at - 8:
                raise self.fault("is truncated: a chunk is longer than the file")
            chunks.setdefault(kind, data[at + 8 : at + 8 + size])
            at += 8 + size
        return chunks.get(JSON_CHUNK, b""), chunks.get(BINARY_CHUNK)

    def _parsed(self, text: bytes) -> Json:
        if text.startswith(b"version https://git-lfs"):
            raise self.fault("is a pointer of Git LFS, which stands for the file: git lfs pull brings it")
        if len(text) > MOST_JSON:
            raise self.fault(f"its JSON has {len(text)} bytes; at most {MOST_JSON} are read")
        try:
            found = json.loads(text.decode("utf-8-sig"), parse_constant=_refuse_constant, parse_int=_number)
        except (ValueError, RecursionError) as error:
            raise self.fault(f"is no well-formed JSON: {str(error)[:120]}") from None
        if not isinstance(found, dict):
            raise self.fault("is no glTF: its JSON is no object")
        return found

    def _view(self, index: Any, where: str) -> tuple[bytes, int | None]:
        """The bytes of a bufferView, and its stride."""
        item = self.item("bufferViews", index, where)
        place = f"bufferView {index}"
        for name in item.get("extensions", {}):
            if name.endswith("meshopt_compression"):
                raise self.fault(f"{place}: is compressed ({name}), which is not read; export without compression")
        data = self._buffer(self.count(item, "buffer", place))
        offset, length = self.count(item, "byteOffset", place, 0), self.count(item, "byteLength", place)
        if offset + length > len(data):
            raise self.fault(f"{place}: ends behind the end of its buffer of {len(data)} bytes")
        return data[offset : offset + length], self.count(item, "byteStride", place) if "byteStride" in item else None

    def _copied(self, layout: Json, like: Json, count: int, components: int, where: str) -> Array:
        """Numbers at the view and offset of `layout`, of the type of `like`."""
        component = like.get("componentType")
        kind = TYPES.get(int(component)) if is_index(component) else None
        if kind is None:
            raise self.fault(f"{where}: componentType: {str(component)[:20]} is none of {list(TYPES)}")
        data, stride = self._view(layout.get("bufferView"), where)
        offset, size = self.count(layout, "byteOffset", where, 0), components * np.dtype(kind).itemsize
        stride = stride or size
        if stride < size:
            raise self.fault(f"{where}: the byteStride of its bufferView is shorter than one element")
        if count and offset + (count - 1) * stride + size > len(data):
            raise self.fault(f"{where}: announces {count} elements, which are more than its bufferView has")
        if not count:
            return np.zeros((0, components))
        raw = np.ndarray(
            (count, components), np.dtype(kind).newbyteorder("<"), data, offset, (stride, size // components)
        )
        found = raw.astype(np.float64)
        if like.get("normalized"):
            if kind in (np.float32, np.uint32):
                raise self.fault(f"{where}: normalized: is for bytes and shorts only")
            found = np.maximum(found / np.iinfo(kind).max, -1.0)
        return found

    def _add_sparse(self, item: Json, found: Array, place: str) -> None:
        """Puts the values that the accessor lists in the place of the others."""
        sparse = item["sparse"]
        if not all(isinstance(part, dict) for part in (sparse, *(_part(sparse, key) for key in ("indices", "values")))):
            raise self.fault(f"{place}: sparse: needs indices and values")
        count = self.count(sparse, "count", f"{place}: sparse")
        where = self._copied(sparse["indices"], sparse["indices"], count, 1, f"{place}: sparse indices")[:, 0]
        values = self._copied(sparse["values"], item, count, found.shape[1], f"{place}: sparse values")
        if (where != np.floor(where)).any() or (where < 0).any() or (where >= len(found)).any():
            raise self.fault(f"{place}: sparse: an index is out of range")
        found[where.astype(np.int64)] = values

    def _buffer(self, index: int) -> bytes:
        if index not in self._buffers:
            self._buffers[index] = self._read_buffer(index)
        return self._buffers[index]

    def _read_buffer(self, index: int) -> bytes:
        place = f"buffer {index}"
        item = self.item("buffers", index, place)
        data = self._binary if "uri" not in item else self._decoded(item["uri"], place)
        if data is None or (index > 0 and "uri" not in item):
            raise self.fault(f"{place}: has no uri, and there is no binary chunk for it")
        length = self.count(item, "byteLength", place)
        if length > len(data):
            raise self.fault(f"{place}: announces {length} bytes, but there are {len(data)}")
        return data[:length]

    def _decoded(self, uri: Any, place: str) -> bytes:
        """The bytes of a data URI or of a file beside this one."""
        if not isinstance(uri, str) or not uri or "://" in uri[:40]:
            raise self.fault(f"{place}: uri: {str(uri)[:60]!r} is no file; only files and embedded data are read")
        if uri.startswith("data:"):
            head, comma, text = uri.partition(",")
            if not comma or not head.endswith(";base64"):
                raise self.fault(f"{place}: uri: only data in base64 is read")
            try:
                return base64.b64decode(text + "=" * (-len(text) % 4), validate=True)
            except (binascii.Error, ValueError):
                raise self.fault(f"{place}: uri: is no base64") from None
        file = self.path.parent / urllib.parse.unquote(uri)
        self.files.add(file)
        return self._bytes_of(file)


def is_index(value: Any) -> TypeGuard[float]:
    """Whether a value of JSON is an integer from 0 on."""
    return (
        isinstance(value, (int, float)) and not isinstance(value, bool) and 0 <= value < 2**53 and value == int(value)
    )


def _is_marker(node: Json) -> bool:
    extras = node.get("extras")
    event = extras.get("chasles") if isinstance(extras, dict) else None
    return isinstance(event, dict) and "pair" in event and "mesh" in node and not node.get("children")


def _part(sparse: Any, key: str) -> Any:
    return sparse.get(key) if isinstance(sparse, dict) else None


def _padded(data: bytes, with_byte: bytes) -> bytes:
    return data + with_byte * (-len(data) % 4)


def _chunk(kind: int, data: bytes, with_byte: bytes) -> bytes:
    data = _padded(data, with_byte)
    return struct.pack("<II", len(data), kind) + data


def _number(text: str) -> float:
    return int(text) if len(text) < 20 else float(text)


def _refuse_constant(name: str) -> None:
    raise ValueError(f"{name} is no number of JSON")
