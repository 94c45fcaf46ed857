"""Enumerations of queries and answers. Their members are strings: ``found.verdict == "clear"`` works."""

from enum import Enum


class _Word(str, Enum):
    def __str__(self) -> str:
        return self.value


class Verdict(_Word):
    """The proven result. A verdict has no truth value, so that no verdict can be mistaken for "clear"."""

    unknown = "unknown"  #: no answer: a `Limit` was reached before
    clear = "clear"  #: no contact on [0, 1]
    contact = "contact"  #: first contact inside the bracket of time, none before its lower end
    contact_at_start = "contact_at_start"  #: at time 0 the surfaces touch or cross, or one body is inside of the other

    def __bool__(self) -> bool:
        raise TypeError("a verdict has no truth value: compare it, as in `found.verdict == chasles.Verdict.clear`")


class Find(_Word):
    """The answer that a query has to find."""

    first = "first"  #: the first contact and one feature pair at it
    any = "any"  #: yes or no: the query stops at any contact, which need not be the earliest
    first_with_all_contacts = "first_with_all_contacts"  #: and every feature pair in contact within the bracket


class ContactKind(_Word):
    """The two features in contact. The first belongs to the moving body, the second to the fixed body.

    The last three kinds occur at the rims of faces and at the ends of edges. The features then allow many normals, and
    the contact has one of them.
    """

    vertex_face = "vertex_face"
    face_vertex = "face_vertex"
    edge_edge = "edge_edge"
    vertex_edge = "vertex_edge"
    edge_vertex = "edge_vertex"
    vertex_vertex = "vertex_vertex"
