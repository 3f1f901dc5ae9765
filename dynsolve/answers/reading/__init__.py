"""Reading answers: text and LaTeX as people write them -> trees in the symbols of the problem.

The way of one line, `D_{11} = m_1 l_{c1}^2 + I_1` in a report, to a value:

1. `files` knows the format by the file's ending; `reports`, `answer_file` or `web` (pages and notebooks)
   finds the displayed equations, each a `displays.Display` (`report_text` leaves comments away;
   `plain_text`, `printed_rows` and `dh_tables` find equations that are no displays; pandoc reads Word).
   `sources` keeps where every character stands in the file, and says how much is read.
2. `lexer` cuts the text of a display into letters, numbers, commands and signs, and writes the student's
   macros out; nothing there depends on the problem.
3. `prepare` leaves out fonts, sizes and environments that only align, so that one thing has one spelling
   from here on.
4. `displays` cuts the tokens into equations, and these at `=` into members.
5. `equation_reader` takes the equations in order, and keeps what the student defines;
   `asides` are formulas in sentences, by the words of `report_text`.  `left_side` finds which
   answers a member names (d11), and which value it has.  A name and a formula that can be nothing else,
   as most are, take none of these ways: `plain` reads them from their text.
6. For both, `name_splitting` cuts runs of letters into the names of the problem (`m_2gL_1`), and
   `grammar` descends over the tokens; what a name means is looked up in the `vocabulary` of
   the problem.  A value is a tree, or a matrix of trees (`grids`).
7. `answer_list` makes the record (`answers.verdict.Answer`), under the name whose shape
   the value has (`matrix_parts`), and settles at the end what needs the whole file: of what is given
   twice, what cannot be read never takes the place of what can.

Every equation ends as an answer, in `not_recognized`, which the student is shown, or in
`left_alone`, each with its reason: a path through `equation_reader` that leaves no record is a fault.

`configurations` reads sets: singular configurations, branches of the inverse kinematics; `set_text`
takes apart what words join in them, and the vectors of a space; `displayed_sets` finds those of a report.
`matrix_parts` are rows, columns and entries of a matrix, `dh_tables` tables of Denavit-Hartenberg
parameters, `by_content` names that mean an answer only where their value says so, and equations of motion
whose sides name none; `vocabulary` knows what the indices of a Christoffel symbol mean; `asides` lists
what names an answer where nothing is read.  The values of an answer file come from `yaml_values` or,
where YAML refuses the file, from `answer_file`, which reads them.

Modules import only those of earlier layers: text (`sources`, `lexer`, `prepare`, `displays`), names
(`grids`, `vocabulary`, `name_splitting`), `grammar`, equations (`matrix_parts`, `left_side`, `by_content`,
`answer_list`, `plain`, `equation_reader`, `asides`, `answer_file`), formats (the rest).

To read one more format, write a file that finds its displays, and name its ending in `files`; one
more notation is a row or a module of `grammar`.

Where a fault is: a wrong place in a message is `sources`; a wrong sign or command `lexer`; an
equation cut in two, or a lost label `displays`; a name not known, or taken for another `vocabulary`
and `grammar.names`; a formula that is refused `grammar`; an answer under a wrong name `left_side`;
an answer that is missing although it was read `equation_reader`.
"""
