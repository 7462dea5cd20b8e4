"""Small scenes up to their assembly, to which a test appends what it loads the packing by. The files also serve the tests
in C++ (scene_text.h)."""
import pathlib


def scene_text(name, *exchanges):
    """The text of a scene with parts of it, which it has to have, exchanged for others."""
    text = (pathlib.Path(__file__).resolve().parent / "scenes" / f"{name}.toml").read_text()
    for old, new in exchanges:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
