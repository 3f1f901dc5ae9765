"""Names: one spelling, and how they are set on paper."""

from __future__ import annotations

import pytest

from dynsolve.errors import ReadError
from dynsolve.notation.characters import GREEK, normalize, split

SPELLINGS = [
    ("m1", "m1"),
    ("θ1", "theta1"),
    ("θ₁", "theta1"),
    ("ϑ1", "theta1"),
    ("theta1", "theta1"),
    ("µ", "mu"),  # the micro sign
    ("μ", "mu"),  # the Greek letter
    ("ΔL", "DeltaL"),
    ("I₁zz", "I1zz"),
    ("lambda", "lambda"),
    ("lambda_", "lambda"),
    ("None_", "None"),
    ("m_1", "m_1"),
    ("x_", "x_"),
]


@pytest.mark.parametrize(("written", "name"), SPELLINGS)
def test_normalize(written, name):
    assert normalize(written) == name


@pytest.mark.parametrize(("name", "letter"), GREEK.items())
def test_greek_letters_are_read_both_ways(name, letter):
    assert normalize(letter) == normalize(name) == name
    assert split(name + "2") == (name, ("2",))


REFUSED = [
    ("", 0, "a name is expected"),
    ("1m", 0, "cannot begin with `1`"),
    ("_m", 0, "cannot begin with `_`"),
    ("m 1", 1, "no meaning"),
    ("m-1", 1, "no meaning"),
    ("m1\n", 2, "U+000A"),
    ("\u0430", 0, "U+0430 CYRILLIC SMALL LETTER A"),
    ("m\u0435", 1, "U+0435 CYRILLIC SMALL LETTER IE"),
    ("\u0391", 0, "U+0391 GREEK CAPITAL LETTER ALPHA"),
    ("\u03bf", 0, "U+03BF GREEK SMALL LETTER OMICRON"),
    ("\uff4d1", 0, "FULLWIDTH"),
    ("l\u0661", 1, "U+0661 ARABIC-INDIC DIGIT ONE"),
    ("m\u200b1", 1, "U+200B"),
    ("m\u202e1", 1, "U+202E"),
    ("m\x001", 1, "U+0000"),
    ("\ud800", 0, "U+D800"),
    ("é", 0, "U+00E9"),
]


@pytest.mark.parametrize(("written", "offset", "words"), REFUSED)
def test_what_is_no_name(written, offset, words):
    with pytest.raises(ReadError) as caught:
        normalize(written)
    assert caught.value.offset == offset
    assert words in caught.value.message
    assert caught.value.help


def test_the_remedy_names_the_letter_that_is_meant():
    with pytest.raises(ReadError) as caught:
        normalize("\u0430lpha")
    assert "`a`" in caught.value.help


SET = [
    ("g", "g", ()),
    ("m1", "m", ("1",)),
    ("m_1", "m", ("1",)),
    ("q12", "q", ("12",)),
    ("I1zz", "I", ("1", "zz")),
    ("I1_zz", "I", ("1", "zz")),
    ("Ixx1", "I", ("xx1",)),
    ("I_xx_1", "I", ("xx", "1")),
    ("Ixx", "I", ("xx",)),
    ("Ixxc1", "I", ("xxc1",)),
    ("lc1", "l", ("c1",)),
    ("ml1", "m", ("l1",)),
    ("mm2", "m", ("m2",)),
    ("Il1", "I", ("l1",)),
    ("kr1", "k", ("r1",)),
    ("theta", "theta", ()),
    ("theta1", "theta", ("1",)),
    ("Theta1", "Theta", ("1",)),
    ("alpha2", "alpha", ("2",)),
    ("alphac1", "alpha", ("c1",)),
    ("thetamax", "theta", ("max",)),
    ("lambda", "lambda", ()),
    ("mu", "mu", ()),
    ("mus", "mu", ("s",)),
    ("mu_s", "mu", ("s",)),
    ("pi1", "pi", ("1",)),
    ("pin", "p", ("in",)),
    ("nuance", "nuance", ()),
    ("load", "load", ()),
    ("load1", "load", ("1",)),
    ("m_load", "m", ("load",)),
    ("h0", "h", ("0",)),
]


@pytest.mark.parametrize(("name", "base", "groups"), SET)
def test_split(name, base, groups):
    assert split(name) == (base, groups)
