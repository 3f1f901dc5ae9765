r"""Text -> tokens with one spelling for one thing: `\mathbf{q}_{1}`, `{q}_1` and `q_1` are the same.

`lexer` cuts the text, writes macros out and tells words from names; `prepare` goes over the tokens once
and leaves out what only sets type: groups in braces are dissolved, environments that align left out.
Nothing here depends on the problem.
"""
