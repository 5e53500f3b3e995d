"""A language server for problem files: mistakes, completion, formulas as they are printed.

`python -m lagcli.lsp` speaks the Language Server Protocol on its standard streams.  What it
answers is in `features`; only `__main__` needs pygls, the extra `lsp`.
"""
