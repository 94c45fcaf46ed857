"""The bodies of a file of glTF, for `chasles.gltf`."""

from __future__ import annotations

import pathlib
import tempfile
from typing import Any

from ._core import InvalidInput, Polyhedron, load_parts
from .gltf_file import Document, Json
from .gltf_tree import Carrier


def load_bodies(document: Document, carriers: list[Carrier], **options: Any) -> dict[str, Polyhedron]:
    """The body of each carrier in the frame of its mover. The package's own reader reads a file in which each carrier is a root."""
    json: Json = {
        key: document.json[key] for key in ("asset", "accessors", "bufferViews", "meshes") if key in document.json
    }
    required = document.json.get("extensionsRequired", [])
    if isinstance(required, list):
        json["extensionsRequired"] = [name for name in required if name != "KHR_animation_pointer"]
    nodes: list[Json] = [{} for _ in document.items("nodes")]
    for carrier in carriers:
        given = document.items("nodes")[carrier.node]
        kept: Json = {key: given[key] for key in ("mesh", "extensions", "weights") if key in given}
        nodes[carrier.node] = {**kept, "name": carrier.name, "matrix": carrier.to_mover.T.reshape(-1).tolist()}
    json |= {"nodes": nodes, "scenes": [{"nodes": [carrier.node for carrier in carriers]}], "scene": 0}
    with tempfile.TemporaryDirectory(prefix="chasles-") as folder:
        file = pathlib.Path(folder, "scene.glb")
        file.write_bytes(document.as_glb(json))
        try:
            return load_parts(file, **options)
        except InvalidInput as error:
            raise InvalidInput(str(error).replace(str(file), str(document.path))) from None
