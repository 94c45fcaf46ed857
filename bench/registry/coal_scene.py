"""Many bodies of one shape in Coal's DynamicAABBTreeCollisionManager: see bench/peer_scene.h for the protocol."""

import protocol

try:
    import coal
    import numpy as np
except ImportError as error:
    protocol.absent(str(error))
    raise SystemExit from None


class CoalScene:
    """One manager, whose objects are made at the first placement and moved afterwards."""

    def __init__(self) -> None:
        self.model = None
        self.radius = 0.0  # around the origin of the shape
        self.objects: list[coal.CollisionObject] = []
        self.manager = coal.DynamicAABBTreeCollisionManager()

    def body(self, text: str) -> str:
        words = text.split()
        vertices, triangles = int(words[0]), int(words[1])
        numbers = np.array(words[2 : 2 + 3 * vertices], dtype=float).reshape(-1, 3)
        faces = np.array(words[2 + 3 * vertices :], dtype=int).reshape(triangles, 3)
        self.radius = float(np.linalg.norm(numbers, axis=1).max())
        self.model = coal.BVHModelOBBRSS()
        self.model.beginModel(triangles, vertices)
        self.model.addVertices(numbers)
        self.model.addTriangles(faces)
        self.model.endModel()
        return "done"

    def place(self, text: str) -> str:
        numbers = np.array(text.split()[1:], dtype=float).reshape(-1, 7)
        is_first = not self.objects
        for index, (w, x, y, z, *translation) in enumerate(numbers):
            place = coal.Transform3s(coal.Quaternion(w, x, y, z).matrix(), np.array(translation))
            if is_first:
                self.objects.append(coal.CollisionObject(self.model, place))
                self.manager.registerObject(self.objects[-1])
            self.objects[index].setTransform(place)
            self.objects[index].computeAABB()
        if is_first:
            self.manager.setup()
        return "done"

    def is_clear(self) -> bool:
        """What a user calls in each step: it stops at the first pair that overlaps."""
        self.manager.update()
        callback = coal.CollisionCallBackDefault()
        callback.data.request = request()
        self.manager.collide(callback)
        return not callback.data.result.isCollision()

    def overlapping(self) -> list[str]:
        """The indices of all pairs that overlap. The manager does not tell them in Python: balls find who is near."""
        places = np.array([o.getTranslation() for o in self.objects])
        pairs: list[str] = []
        for i, place in enumerate(places):
            away = np.linalg.norm(places[i + 1 :] - place, axis=1)
            for j in i + 1 + np.flatnonzero(away <= 2 * self.radius):
                if coal.collide(self.objects[i], self.objects[j], request(), coal.CollisionResult()):
                    pairs += [str(i), str(j)]
        return pairs

    def timed_pass(self, _text: str) -> str:
        is_clear, seconds = protocol.timed(self.is_clear)
        return " ".join([f"found {seconds!r}", *([] if is_clear else self.overlapping())])


def request() -> "coal.CollisionRequest":
    request = coal.CollisionRequest(coal.CollisionRequestFlag.NO_REQUEST, 1)
    request.break_distance = 0.0  # see docs/decisions/0040-peers.md
    return request


def main() -> None:
    scene = CoalScene()
    protocol.serve({"body": scene.body, "place": scene.place, "pass": scene.timed_pass})


if __name__ == "__main__":
    main()
