"""STEP files by OCCT's reader, with the names, colours and places of their assembly tree, for `chasles.cad`."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from typing import Any

from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Quantity import Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_ChildIterator, TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFDoc import XCAFDoc_ColorTool, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from ._core import InvalidInput
from .cad_tree import Colour, Node, matrix_of, split, without_place
from .read_file import as_regular_file


def read_step(path: str | os.PathLike[str]) -> Node:
    """The tree of a STEP file. Lengths are millimetres, whatever unit the file has."""
    file = pathlib.Path(path)
    if not file.exists() or file.is_dir():
        raise InvalidInput(f"{file}: is no file")
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    with as_regular_file(file) as named:
        is_read = reader.ReadFile(str(named)) == IFSelect_ReturnStatus.IFSelect_RetDone
    if not is_read or not reader.Transfer(document):
        raise InvalidInput(f"{file}: is no STEP file that OCCT can read")
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    free = [label for label in _children(shapes.Label()) if XCAFDoc_ShapeTool.IsFree_s(label)]
    nodes = [_node(label, colours, None) for label in free]
    if not nodes:
        raise InvalidInput(f"{file}: has no shapes")
    root = nodes[0] if len(nodes) == 1 else Node(file.stem, children=nodes)
    root.name = root.name or file.stem
    return root


def _node(label: Any, colours: Any, inherited: Colour | None) -> Node:
    """A label of the tree: an instance of a part or of an assembly, or these themselves."""
    shape = XCAFDoc_ShapeTool.GetShape_s(label)
    source = TDF_Label()
    is_instance = XCAFDoc_ShapeTool.GetReferredShape_s(label, source)
    source = source if is_instance else label
    colour = _colour(label, colours) or _colour(source, colours) or inherited
    name = _name(label) or _name(source)
    node = Node(name, matrix_of(shape.Location()), colour)
    if XCAFDoc_ShapeTool.IsAssembly_s(source):
        components = [child for child in _children(source) if XCAFDoc_ShapeTool.IsComponent_s(child)]
        node.children = [_node(child, colours, colour) for child in components]
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
