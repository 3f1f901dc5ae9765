"""Web pages: formulas as MathJax, KaTeX and the editors of learning platforms leave them."""

from __future__ import annotations

import pytest

from tests.unit.answers.reading.submissions import named, report

PAGES = [
    "<p>\\[ K = m_1 \\]</p>",
    "<p><span class='math display'>\\[K = m_1\\]</span></p>",
    "<div>$$K = m_1$$</div>",
    "<script type='math/tex; mode=display'>K = m_1</script>",
    "<span class='katex-display'><span class='katex'><span class='katex-mathml'><math><semantics><mi>K</mi>"
    "<annotation encoding='application/x-tex'>K = m_1</annotation></semantics></math></span>"
    "<span class='katex-html'>K=m1</span></span></span>",
    "<script>var x = '$$P = 3$$';</script><p>$$K = m_1$$</p>",
    "<p>$$K = m_1 &amp; $$</p>".replace(" &amp;", ""),
    "<!-- $$P = 3$$ --><p>$$K = m_1$$</p>",
    r"<p>so \(P = 3\) at rest</p><p><span class='nolink'>\(K = m_1\)</span></p>",
    "<p><img class='equation_image' title='K = m_1' src='/equation_images/K' alt='LaTeX: K = m_1' "
    "data-equation-content='K = m_1'></p>",
    "<p><img class='equation_image' src='/equation_images/K' alt='LaTeX: K = m_1'></p>",
    "<p><img class='texrender' title='K = m_1' alt='K = m_1' src='/filter/tex/pix.php/1.gif'></p>",
    "<p>so <img class='equation_image' data-equation-content='P = 3'> holds, $$K = m_1$$ <img src='x'></p>",
]


@pytest.mark.parametrize("text", PAGES)
def test_a_web_page_is_read_by_its_formulas(text: str) -> None:
    found = report(f"<html><head><title>x</title></head>\n<body>{text}</body></html>", "report.html")
    assert named(found) == [("K", "")]
    assert found.answers[0].place.line == 2
