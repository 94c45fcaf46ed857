"""The type of a value in messages."""


def with_article(value: object) -> str:
    """Return "a str" or "an int", the name of the type of a value."""
    name = type(value).__name__
    return ("an " if name[0].lower() in "aeiou" else "a ") + name
