"""Words that answers and questions are made of. Members are strings: ``found.verdict == "clear"`` holds as well."""

from enum import Enum


class _Word(str, Enum):
    def __str__(self) -> str:
        return self.value


class Verdict(_Word):
    """What is proven. It has no truth value: "could not tell" must not be mistaken for "clear"."""

    clear = "clear"  #: no contact on [0, 1]
    contact = "contact"  #: first contact inside the bracket of time, none before its lower end
    contact_at_start = "contact_at_start"  #: already touching or overlapping at time 0

    def __bool__(self) -> bool:
        raise TypeError("a verdict has no truth value: compare it, as in `found.verdict == chasles.Verdict.clear`")


class Find(_Word):
    """Where a query may stop."""

    first = "first"  #: the first contact and one feature pair at it
    any = "any"  #: yes or no: stops at the first contact that it meets, which need not be the earliest
    first_with_all_contacts = "first_with_all_contacts"  #: and every feature pair in contact within the bracket


class ContactKind(_Word):
    """First named feature: of the moving body. Second: of the fixed body.

    The last three are met at the rims of faces and at the ends of edges: there the normal is one of many that the
    features allow.
    """

    vertex_face = "vertex_face"
    face_vertex = "face_vertex"
    edge_edge = "edge_edge"
    vertex_edge = "vertex_edge"
    edge_vertex = "edge_vertex"
    vertex_vertex = "vertex_vertex"
