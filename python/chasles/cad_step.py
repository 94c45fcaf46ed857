"""STEP files by OCCT's reader, with the names, colours and places of their assembly tree, for `chasles.cad`.

A part may be in a file of its own, beside the file that names it (DOCUMENT_FILE). OCCT reads these files too, and leaves
the part empty where one is not there.
"""

from __future__ import annotations

import os
import pathlib
import re
from collections.abc import Iterator
from typing import Any

from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Quantity import Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_ChildIterator, TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.XCAFDoc import XCAFDoc_ColorTool, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from ._core import InvalidInput
from .cad_tree import Colour, Node, matrix_of, split, walk, without_place
from .read_file import as_regular_file

_DOCUMENT_FILE = re.compile(rb"DOCUMENT_FILE\s*\(\s*'((?:[^']|'')*)'")


def read_step(path: str | os.PathLike[str], skip_empty: bool = False) -> Node:
    """The tree of a STEP file. Lengths are millimetres, whatever unit the file has."""
    file = pathlib.Path(path)
    if not file.exists() or file.is_dir():
        raise InvalidInput(f"{file}: is no file")
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    with as_regular_file(file) as named:
        whole = str(named.absolute())  # OCCT finds the files of external parts beside no relative path
        is_read = reader.ReadFile(whole) == IFSelect_ReturnStatus.IFSelect_RetDone
    if not is_read or not reader.Transfer(document):
        raise InvalidInput(f"{file}: is no STEP file that OCCT can read")
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    free = [label for label in _children(shapes.Label()) if XCAFDoc_ShapeTool.IsFree_s(label)]
    unnamed = _unnamed(reader.Reader().StepModel())
    nodes = [_node(label, colours, None, unnamed) for label in free]
    if not nodes:
        raise InvalidInput(f"{file}: has no shapes")
    root = nodes[0] if len(nodes) == 1 else Node(file.stem, children=nodes)
    root.name = root.name or file.stem
    _require_parts(file, root, skip_empty)
    return root


def _require_parts(file: pathlib.Path, root: Node, skip_empty: bool) -> None:
    """Raises InvalidInput if parts are in files that are not there, and if there are none at all."""
    shapes = [node.shape for _, node, _ in walk(root) if node.shape is not None]
    if not skip_empty and any(not _has(shape, TopAbs_ShapeEnum.TopAbs_VERTEX) for shape in shapes):
        missing = _missing(file, set())
        if missing:
            raise InvalidInput(
                f"{file}: has parts in files that are not there: {', '.join(missing)}; put them beside it, export one file with all "
                "parts, or leave such parts out (skip_empty=True, --skip-empty)"
            )
    if not any(_has(shape, TopAbs_ShapeEnum.TopAbs_FACE) for shape in shapes):
        raise InvalidInput(f"{file}: has no parts: nothing in it has faces")


def _has(shape: Any, kind: Any) -> bool:
    return bool(TopExp_Explorer(shape, kind).More())


def _missing(file: pathlib.Path, seen: set[pathlib.Path]) -> list[str]:
    """The files that a file names, and those that they name, that are not there."""
    seen.add(file.resolve())
    found = []
    for text in dict.fromkeys(_DOCUMENT_FILE.findall(file.read_bytes())):
        name = text.decode("utf-8", "replace").replace("''", "'")
        other = file.parent / name
        if not other.is_file():
            found.append(name)
        elif other.resolve() not in seen:
            found += _missing(other, seen)
    return list(dict.fromkeys(found))


def _unnamed(model: Any) -> set[str]:
    """What OCCT calls instances without a name: by their identifiers, as 1, 2, 3 in files of CadQuery."""
    names, identifiers = set(), set()
    for number in range(1, model.NbEntities() + 1):
        entity = model.Value(number)
        if entity.DynamicType().Name() == "StepRepr_NextAssemblyUsageOccurrence":
            name, identifier = ("" if text is None else text.ToCString().strip() for text in (entity.Name(), entity.Id()))
            names.add(name)
            identifiers |= set() if name else {identifier}
    return identifiers - names


def _node(label: Any, colours: Any, inherited: Colour | None, unnamed: set[str]) -> Node:
    """A label of the tree: an instance of a part or of an assembly, or these themselves."""
    shape = XCAFDoc_ShapeTool.GetShape_s(label)
    source = TDF_Label()
    is_instance = XCAFDoc_ShapeTool.GetReferredShape_s(label, source)
    source = source if is_instance else label
    colour = _colour(label, colours) or _colour(source, colours) or inherited
    name = _name(label)
    name = _name(source) or name if name in unnamed or not name else name
    node = Node(name, matrix_of(shape.Location()), colour)
    if XCAFDoc_ShapeTool.IsAssembly_s(source):
        components = [child for child in _children(source) if XCAFDoc_ShapeTool.IsComponent_s(child)]
        node.children = [_node(child, colours, colour, unnamed) for child in components]
    else:
        node.shape = without_place(shape)
        node.colour = colour or next(filter(None, (_colour(child, colours) for child in _children(source))), None)
        split(node)
        for child in node.children:
            _take_names(child, source, colours)
    return node


def _take_names(solid: Node, source: Any, colours: Any) -> None:
    """The name and the colour of one solid of a part, where the file has them."""
    for label in _children(source):
        if XCAFDoc_ShapeTool.GetShape_s(label).IsPartner(solid.shape):
            solid.name = _name(label) or solid.name
            solid.colour = _colour(label, colours) or solid.colour


def _children(label: Any) -> Iterator[Any]:
    labels = TDF_ChildIterator(label)
    while labels.More():
        yield labels.Value()
        labels.Next()


def _name(label: Any) -> str:
    if not label.IsAttribute(TDataStd_Name.GetID_s()):
        return ""  # FindAttribute ends the process then
    name = TDataStd_Name()
    label.FindAttribute(TDataStd_Name.GetID_s(), name)
    if name.Get().IsEmpty():
        return ""
    text = str(name.Get().ToExtString()).strip()
    return "" if text.startswith("=>[") else text  # OCCT's own name of an instance without one


def _colour(label: Any, colours: Any) -> Colour | None:
    """The colour of all faces; the first one where faces have their own."""
    found = Quantity_ColorRGBA()
    for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
        if XCAFDoc_ColorTool.GetColor_s(label, kind, found):
            rgb = found.GetRGB()
            return (rgb.Red(), rgb.Green(), rgb.Blue())
    return None
