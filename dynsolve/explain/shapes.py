"""What uniform shapes are called in a sentence."""

SHAPES = {
    "box": "rectangular solid",
    "cylinder": "solid cylinder",
    "hollow_cylinder": "hollow cylinder",
    "rod": "slender rod",
    "disk": "thin disk",
    "sphere": "solid sphere",
    "shell": "thin spherical shell",
}
