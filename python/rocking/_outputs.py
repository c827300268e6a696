"""Files that are written whole or not at all."""

import os
import secrets
import shutil
from pathlib import Path


def replace(path: Path, text: str) -> None:
    """Writes `text` in UTF-8; a file that is there is replaced at once.

    The file keeps its mode, and through a link the linked file is replaced.
    """
    target = path.resolve()
    # The command line removes what a killed run leaves under such a name.
    part = target.with_name(f".rocking-{secrets.token_hex(6)}.part")
    try:
        with part.open("xb") as file:
            file.write(text.encode())
        if target.exists():
            shutil.copymode(target, part)
        os.replace(part, target)
    except OSError as error:
        error.filename = os.fspath(path)
        raise
    finally:
        part.unlink(missing_ok=True)
