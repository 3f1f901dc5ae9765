r"""Reading answers: text and LaTeX as people write them -> trees in the symbols of the problem.

The way of one line, `D_{11} = m_1 l_{c1}^2 + I_1` in a report, to a value:

1. `files` knows the format by the file's ending; `reports`, `answer_file`, `notebooks` or `web`
   finds the displayed equations, each a `displays.Display` (`report_text` leaves comments and
   struck-out text away, `plain_lines`, `pretty_print` and `tables` find equations that are no
   displays, `documents` lets pandoc read Word and its like).  `sources` keeps where every character
   stands in the file, `limits` says how much is read.
2. `tokens` cuts the text of a display into letters, numbers, commands and signs, and
3. leaves out fonts, sizes and environments that only align, with the student's macros written out,
   so that one thing has one spelling from here on.
4. `displays` cuts the tokens into equations, and these at `=` into members.
5. `equation_reader` takes the equations in order, and keeps what the student defines;
   `asides` are formulas in sentences, by the words of `sentences`.  `left_side` finds which
   answers a member names (d11), `right_side` which value it has.
6. For both, `name_splitting` cuts runs of letters into the names of the problem (`m_2gL_1`), and
   `grammar` descends over the tokens; what a name means is looked up in the `vocabulary` of
   the problem.  A value is a tree, or a matrix of trees (`grids`); `size` bounds it.
7. `answer_list` makes the record (`answers.submission.Answer`), under the name whose shape
   the value has (`shapes`), and settles at the end what needs the whole file: of what is given
   twice, what cannot be read never takes the place of what can (`occurrences`).

Every equation ends as an answer, in `not_recognized`, which the student is shown, or in
`left_alone`, each with its reason: a path through `equation_reader` that leaves no record is a fault.

`configurations` reads sets: singular configurations, branches of the inverse kinematics; `set_text`
takes apart what words join in them, `coordinate_formulas` reads their formulas, `loose_lists` finds the
lists in what YAML refuses, `span_text` the vectors of a space, `displayed_sets` those of a report;
`headed_sets` those behind their heads, by the words of `set_words`;
`verdicts` what is said of matrices, `spoken_verdicts` in a report.
`definitions` reads the names that an answer file declares under `symbols:` and `let:`;
`other_entries` are those that a sentence says are zero;
`unread_text` lists what names an answer where nothing is read.
`own_coordinates` are those that count a coordinate the other way, `own_names` keeps what follows
from a name of the student's own, `vector_entries` a vector C q̇ that is given row by row,
`matrix_parts` one row or column of a matrix, `dh_tables` tables of Denavit-Hartenberg parameters with
their `dh_heads` and `dh_cells`,
`motion_equations` equations of motion whose sides name no answer, `no_answers` what names one and gives none,
`linear_models` ẋ = A x + B u,
`by_content` names that mean an answer only where their value says so, `index_order` what the indices
of a Christoffel symbol mean.  The values of an answer file are read by `given_values`; they come from
`yaml_values` (what YAML says) and `yaml_scalars` (what stands between quotes), or, where YAML refuses
the file, from `answer_lines`; `placed_text` keeps where each character of a value stands.

Modules import only those of earlier layers: text (`limits`, `sources`, `tokens`, `displays`), names
(`grids`, `index_order`, `vocabulary`, `name_splitting`), `grammar`, equations (`shapes`, `own_names`,
`left_side`, `right_side`, `motion_equations`, `no_answers`, `vector_entries`, `matrix_parts`, `by_content`,
`occurrences`, `answer_list`, `equation_reader`, `asides`, `given_values`, `definitions`), formats (the rest).

To read one more format, write a file that finds its displays, and name its ending in `files`; one
more notation is a row or a module of `grammar`.

Where a fault is: a wrong place in a message is `sources`; a wrong sign or command `tokens`; an
equation cut in two, or a lost label `displays`; a name not known, or taken for another `vocabulary`
and `grammar.names`; a formula that is refused `grammar`; an answer under a wrong name `left_side`;
an answer that is missing although it was read `equation_reader`.
"""
