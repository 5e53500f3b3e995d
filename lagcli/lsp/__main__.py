"""`python -m lagcli.lsp`: the server on standard input and output."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from lagcli import __version__
from lagcli.lsp import features

if TYPE_CHECKING:
    from lagcli.diagnostics import Span


def main() -> int:
    """Serve until the editor ends it."""
    try:
        server()
    except ImportError:
        sys.stderr.write("the language server needs pygls: pip install 'lagcli[lsp]'\n")
        return 2
    return 0


def server() -> None:
    """Answer the editor.

    Raises
    ------
    ImportError
        Where pygls is missing.
    """
    from lsprotocol import types
    from pygls.lsp.server import LanguageServer

    made = LanguageServer("lagcli", __version__)

    def check(uri: str) -> None:
        document = made.workspace.get_text_document(uri)
        found = [
            types.Diagnostic(
                range=document.range_to_client_units(_range(types, each.span)),
                message=f"{each.message}\n{each.hint}".rstrip(),
                severity=types.DiagnosticSeverity[each.severity.title()],
                source="lagcli",
            )
            for each in features.mistakes(document.filename or uri, document.source)
        ]
        made.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, diagnostics=found)
        )

    def changed(params: Any) -> None:
        check(params.text_document.uri)

    def closed(params: Any) -> None:
        uri = params.text_document.uri
        made.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, diagnostics=[])
        )

    def completed(params: Any) -> Any:
        document, place = _place(made, params)
        kinds = types.CompletionItemKind
        return [
            types.CompletionItem(
                label=each.text,
                detail=each.detail,
                insert_text=f"{each.text}: " if each.is_key else each.text,
                kind=kinds.Property if each.is_key else kinds.Variable,
            )
            for each in features.suggestions(document.source, place.line, place.character)
        ]

    def hovered(params: Any) -> Any:
        document, place = _place(made, params)
        text = features.hover(document.source, place.line, place.character)
        if text is None:
            return None
        return types.Hover(types.MarkupContent(types.MarkupKind.Markdown, text))

    made.feature(types.TEXT_DOCUMENT_DID_OPEN)(changed)
    made.feature(types.TEXT_DOCUMENT_DID_CHANGE)(changed)
    made.feature(types.TEXT_DOCUMENT_DID_CLOSE)(closed)
    made.feature(types.TEXT_DOCUMENT_COMPLETION)(completed)
    made.feature(types.TEXT_DOCUMENT_HOVER)(hovered)
    made.start_io()


def _place(made: Any, params: Any) -> tuple[Any, Any]:
    """The document, and the position in characters."""
    document = made.workspace.get_text_document(params.text_document.uri)
    return document, document.position_from_client_units(params.position)


def _range(types: Any, span: Span) -> Any:
    """A span as a range; without a place it is the first line."""
    line, column = max(span.line, 1), max(span.column, 1)
    end = (max(span.end_line, line), max(span.end_column, 1))
    return types.Range(types.Position(line - 1, column - 1), types.Position(end[0] - 1, end[1] - 1))


if __name__ == "__main__":
    sys.exit(main())
