"""What lagcli asks of the machine and of Python: the cache, the stack, counted work, failures."""
