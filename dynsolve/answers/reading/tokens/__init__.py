r"""Text -> tokens with one spelling for one thing: `\mathbf{q}_{1}`, `{q}_1` and `q_1` are the same.

`lexer` cuts the text; `prepare` goes over its tokens once and leaves out what only sets type:
`macros` are written out, `groups` in braces dissolved, `environments` that align left out, and
`words` told from names.  Nothing here depends on the problem.
"""
