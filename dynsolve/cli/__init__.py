"""The commands: one thin file each, with heavy imports inside the command."""
