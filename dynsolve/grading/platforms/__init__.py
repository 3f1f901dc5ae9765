"""The learning platforms: one file each for what it hands out and what it imports.

    owners      whose file it is, asking the platforms in turn
    roster      the table of students that a platform exports
    registry    the platforms by name
    canvas, moodle, gradescope

To add a platform, write a file like `canvas` with

- `owner(parts)`: the `Owner` of a file from the parts of its path, None where the
  platform has not named it; enter it in `owners`;
- `write(folder, problems, record, roster)`: the file that it imports, giving the warnings;
  and, where its roster is needed or tells who was late, `check` and `late`; enter them
  in `registry`, and the name in `cli.grade`.
"""
