"""The formatters that come with lagcli: a module each, named as its format, with `render`."""
