"""Small scenes up to their assembly, to which tests append load stages. Tests in C++ use the same files
(scene_text.h)."""
import pathlib


def scene_text(name, *exchanges):
    """Returns the text of a scene with parts of it replaced; the scene must contain these parts."""
    text = (pathlib.Path(__file__).resolve().parent / "scenes" / f"{name}.toml").read_text()
    for old, new in exchanges:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
