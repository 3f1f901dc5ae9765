"""The learning platforms: one file each for what it hands out and what it imports.

    members         whose file it is, asking the platforms in turn; who the members of a group are
    roster          the table of students that a platform exports
    registry        the platforms by name
    canvas, moodle, gradescope

To add a platform, write a file like `canvas` with

- `owner(parts)`: the `Owner` of a file from the parts of its path, None where the
  platform has not named it; enter it in `members`;
- `write(folder, problems, record, roster)`: the file that it imports, giving the warnings;
  and, where its roster is needed, tells who was late or names its students, `check`, `late`
  and `people`; enter them in `registry`, and the name in `cli.grade`.
"""
