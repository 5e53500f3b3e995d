"""`python -m lagcli` is `lagcli`."""

from lagcli.cli import main

main()
