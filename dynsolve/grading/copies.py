"""Copies of what was handed in, in OUT, where the teacher's page links to them.

A download may be a zip, which no page can link into.  What a browser would run, or not show, is
a text there: nothing that a student wrote runs when the teacher opens it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path, PurePosixPath

from dynsolve.errors import InputError
from dynsolve.grading.uploads import Upload, Uploads, printable
from dynsolve.render.files import write_changed

FOLDER = "hand-ins"

PICTURES = (".png", ".jpg", ".jpeg", ".gif", ".webp", ".bmp")
_SHOWN = (".pdf", *PICTURES)
_SAVED = (
    ".docx", ".doc", ".odt", ".rtf", ".pages", ".xlsx", ".pptx", ".zip", ".rar", ".7z", ".gz", ".tar",
    ".heic", ".tif", ".tiff", ".mp4", ".mov",
)  # fmt: skip
"""What a browser hands on to another program."""


def copy_name(path: str) -> str:
    """The name of the copy of a file, from its path within what was handed in.

    >>> copy_name("ada/rp.yaml"), copy_name("ada/Scan 1.pdf")
    ('ccd1e0b72fa6-rp.yaml.txt', '14d91d99e36b-Scan 1.pdf')
    """
    name = PurePosixPath(path).name
    plain = re.sub(r"[^\w .@+-]", "_", name)[-80:]
    text = "" if PurePosixPath(name).suffix.lower() in (*_SHOWN, *_SAVED) else ".txt"
    return f"{sha256(path.encode('utf-8', errors='replace')).hexdigest()[:12]}-{plain}{text}"


def write_copies(folder: Path, uploads: Uploads, files: Iterable[Upload]) -> None:
    """Write the copies of these files, and remove those of files that are there no more."""
    written: set[Path] = set()
    for upload in files:
        path = folder / FOLDER / copy_name(printable(str(upload.path)))
        try:
            content = uploads.read(upload)
        except InputError:
            continue  # it was there a moment ago, or is told as what cannot be read
        written.add(path)
        write_changed(path, content, durable=False)
    for path in (folder / FOLDER).glob("*"):
        if path not in written and path.is_file():
            path.unlink()
