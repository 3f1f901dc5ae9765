"""What uniform shapes and their dimensions are called in a sentence."""

SHAPES = {
    "box": "rectangular solid",
    "cylinder": "solid cylinder",
    "hollow_cylinder": "hollow cylinder",
    "rod": "slender rod",
    "disk": "thin disk",
    "sphere": "solid sphere",
    "shell": "thin spherical shell",
}

DIMENSIONS = {
    "radius": "radius",
    "length": "length",
    "outer": "outer radius",
    "inner": "inner radius",
}
"""Their dimensions, by their keys in a file; those of a box are its sides along the axes."""
