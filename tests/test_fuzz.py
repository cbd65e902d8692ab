"""A few hundred spoilt inputs each time; `python -m tests.fuzz` runs as many as wanted."""

import json
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fuzz.__main__ import main
from tests.fuzz.batches import Batch, make_input, run_batch
from tests.fuzz.corpus import KINDS, lay_corpus, read_corpus
from tests.fuzz.mutations import mutate
from tests.fuzz.readers import FAILED, RESULT, judge_input
from timelaw.motion.kinds import KINDS as SEGMENTS

POINTS = re.compile(rb'"control": \[\[[^]]*\]')  # the first control point of a piece
MOST_CORPUS = 200_000  # bytes; it is kept with the source


@pytest.mark.parametrize("kind", KINDS)
def test_a_reader_returns_or_says_what_is_wrong(kind, tmp_path_factory):
    folder = tmp_path_factory.mktemp(kind)
    lay_corpus(folder)
    corpus = read_corpus(kind)

    @settings(max_examples=60)
    @given(st.sampled_from(sorted(corpus)), st.randoms(use_true_random=False))
    def judge(name, rng):
        path = folder / f"spoilt-{name}"
        path.write_bytes(mutate(rng, corpus[name], list(corpus.values())))
        outcome = judge_input(kind, path)
        assert outcome.verdict not in FAILED, outcome.message

    judge()


@pytest.mark.parametrize("kind", KINDS)
def test_the_corpus_is_read(kind, tmp_path):
    lay_corpus(tmp_path)
    for name in read_corpus(kind):
        outcome = judge_input(kind, tmp_path / name)
        assert outcome.verdict == RESULT, outcome.message


def test_the_corpus_has_segments_of_every_kind_and_spoils_them():
    laws = [json.loads(content) for content in read_corpus("law").values()]
    assert {segment["kind"] for law in laws for segment in law["segments"]} == set(SEGMENTS)
    spoilt = [make_input(5, number, "law")[2] for number in range(200)]
    points = {point for content in read_corpus("law").values() for point in POINTS.findall(content)}
    assert any(set(POINTS.findall(content)) - points for content in spoilt)


def test_the_corpus_is_small():
    assert sum(len(content) for kind in KINDS for content in read_corpus(kind).values()) < MOST_CORPUS


def test_a_run_is_the_same_every_time():
    assert make_input(1, 7) == make_input(1, 7)
    assert run_batch(Batch(1, 0, 10), 60.0).outcomes == run_batch(Batch(1, 0, 10), 60.0).outcomes


def test_the_command_counts(tmp_path, capsys):
    arguments = [
        "--count",
        "60",
        "--seed",
        "3",
        "--reader",
        "table",
        "--processes",
        "1",
        "--failures",
        str(tmp_path),
    ]
    assert main(arguments) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:2] == ["reader", "inputs"]
    assert lines[-2].split()[:2] == ["all", "60"]
    assert lines[-1].startswith("peak memory: ")
