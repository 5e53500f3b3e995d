"""LaTeX to PDF by the LaTeX of this machine, the same bytes for the same page."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import click

#: Whatever comes first on the path; all of them take the same options.
_ENGINES = ("pdflatex", "lualatex", "xelatex")
_OPTIONS = ("-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "-jobname=page")
#: pdfTeX would name the file by its place and the time.
_NAMELESS = r"\ifdefined\pdftrailerid\pdftrailerid{}\fi\input{page.tex}"
_SECONDS = 300
_MISSING = (
    "a PDF needs LaTeX, which is not installed: on Debian and Ubuntu, "
    "sudo apt-get install texlive-latex-base; elsewhere TeX Live, MacTeX or MiKTeX; "
    "--format latex --standalone writes the page that it compiles"
)


class LatexError(Exception):
    """LaTeX has stopped: its own message."""


def demand_latex(output: Path | None) -> None:
    """Make sure that a PDF can be made, and has a place.

    Raises
    ------
    click.UsageError
        Where there is no LaTeX, or the PDF would go to the terminal.
    """
    if _engine() is None:
        raise click.UsageError(_MISSING)
    if output is None and sys.stdout.isatty():
        raise click.UsageError("a PDF is not for a terminal: give -o PATH")


def to_pdf(page: str) -> bytes:
    """The PDF of a whole LaTeX document.

    Raises
    ------
    LatexError
        When it does not compile.
    """
    engine = _engine()
    if engine is None:
        raise LatexError(_MISSING)
    environment = {**os.environ, "SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"}
    with TemporaryDirectory(prefix="lagcli-") as folder:
        Path(folder, "page.tex").write_text(page, "utf-8")
        done = subprocess.run(  # noqa: S603 - nothing of the page is in the arguments
            [engine, *_OPTIONS, _NAMELESS],
            cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
            check=False, timeout=_SECONDS,
        )  # fmt: skip
        made = Path(folder, "page.pdf")
        if done.returncode or not made.exists():
            raise LatexError(_complaint(done.stdout.decode("utf-8", "replace"), engine))
        return made.read_bytes()


def _engine() -> str | None:
    return next(filter(None, map(shutil.which, _ENGINES)), None)


def _complaint(log: str, engine: str) -> str:
    """The first line that TeX marks as an error."""
    lines = [line for line in log.splitlines() if line.startswith("!")]
    said = lines[0].removeprefix("! ") if lines else "no message"
    return f"{Path(engine).name} stopped: {said}"
