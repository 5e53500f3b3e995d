"""The motion in machine code: Taylor series, by LLVM where llvmlite is installed.

`tape` makes operations of the nodes, `emission` their recurrences as code, `engine` machine
code of it; `kernels` is the loop over the steps, written in a part of Python that
`language` translates; `machine` puts both together.
"""
