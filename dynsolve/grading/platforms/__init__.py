"""The learning platforms: one file each for what it hands out and what it imports.

    roster          the table of students that a platform exports
    registry        the platforms by name; whose file it is, asking them in turn; who a group's members are
    canvas, moodle, gradescope

To add a platform, write a file like `canvas` with

- `owner(parts)`: the `Owner` of a file from the parts of its path, None where the
  platform has not named it; enter it in `registry`;
- `write(folder, problems, record, roster)`: the file that it imports, giving the warnings;
  and, where its roster is needed, tells who was late or names its students, `check`, `late`
  and `people`; enter them there, too, and the name in `cli.grade`.
"""
