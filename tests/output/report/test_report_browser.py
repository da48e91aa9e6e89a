import json
import re
import shutil
import subprocess
from html import escape, unescape

import pytest
from mpi4py import MPI

import mgehl
from mgehl.output.report.page import render
from mgehl.output.report.run_report import report
from mgehl.output.report.study_report import study_report
from mgehl.output.study_directory import StudyRecord, write_record

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(BROWSER is None, reason="no chromium on this machine: apt-get install chromium"),
]

SETTINGS = {
    "point": {"motion.speed": "0.1 m/s", "solver.max_steps": 3},
    "wedge": {"contact.kind": "wedge", "wedge.pillar": "square", "motion.speed": "1 m/s"},
}

WIDTHS = (1200, 400)
LIGHT = ("rgb(27, 31, 36)", "rgb(255, 255, 255)")

LOOK = """
const inBox = element => element.closest(".scroll") && !element.matches(".scroll");
const shown = element => element.getClientRects().length > 0;
const name = element => element.tagName + " " + element.textContent.trim().slice(0, 40);
const all = selector => [...document.querySelectorAll(selector)].filter(shown);

function sticksOut(element) {
  const box = element.getBoundingClientRect();
  return box.right > document.documentElement.clientWidth + 1 || box.left < -1;
}

function overlap(one, other) {
  const a = one.getBoundingClientRect(), b = other.getBoundingClientRect();
  const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return wide > 1 && high > 1;
}

function overlapping(parent) {
  const children = [...parent.children].filter(shown);
  const pairs = children.flatMap((one, k) => children.slice(k + 1).map(other => [one, other]));
  return pairs.filter(pair => overlap(...pair)).map(pair => pair.map(name).join(" | "));
}

function cutOff(element) {
  return element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).display !== "inline";
}

function look() {
  document.querySelectorAll("details").forEach(each => { each.open = true; });
  const page = document.documentElement, colours = getComputedStyle(document.body);
  return {
    width: page.clientWidth,
    scrolls: page.scrollWidth > page.clientWidth,
    outside: all("body *").filter(each => !inBox(each)).filter(sticksOut).map(name),
    overlapping: all("body *").flatMap(overlapping),
    cutOff: all("td, th, dd, dt, p, a, h1, h2").filter(cutOff).map(name),
    pictures: all("img").map(each => [each.naturalWidth, each.getBoundingClientRect().width]),
    fetched: performance.getEntriesByType("resource").map(each => each.name),
    texts: all("main p, main td, main th").filter(each => each.textContent.trim()).length,
    ink: colours.color,
    paper: colours.backgroundColor,
  };
}
addEventListener("load", () => {
  parent.document.getElementById("found").textContent = JSON.stringify(look());
});
"""
"""What is measured inside the page; overflow inside of boxes that scroll is what they are for."""


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """HTML of a run that did not converge, of a wedge and of a study."""
    study = tmp_path_factory.mktemp("browser") / "study-wedge"
    study.mkdir()
    heads = ",".join(f"quantity {k} 1/mm" for k in range(24))
    (study / "cases.csv").write_text(f"case,{heads}\n" + 30 * f"cylindrical pillar, {23 * '1.25e-3,'}2\n")
    solved = {}
    for kind, settings in SETTINGS.items():
        config = mgehl.load(settings={"grid.nodes": 65} | settings)
        solved[kind] = report(mgehl.solve(config, MPI.COMM_SELF), "a-run-with-a-long-name-" + 8 * "x")
    (study / "figure_7.png").write_bytes(_a_picture())
    write_record(study, StudyRecord("wedge", (65,), 1, {}))
    return solved | {"study": render(study_report(study, {}))}


def _a_picture():
    from mgehl.output.pictures import style

    with style.applied():
        figure, _ = style.subplots(size=(10.0, 4.0))
        return style.rendered(figure, "png")


def browse(path, *options):
    """The document after its scripts have run, and what the console said."""
    command = [
        BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
        "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={path.parent / 'profile'}",
        "--virtual-time-budget=10000", "--window-size=1300,1000", *options, "--dump-dom", path.as_uri(),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
    return done.stdout, said


def measured(html, width, directory, *options):
    """What `look` finds in a page shown `width` wide, and what the console said.

    The page stands in a frame: a window of a headless browser is 500 wide at the least.
    """
    framed = escape(html.replace("</body>", f"<script>{LOOK}</script></body>"))
    frame = f'<iframe srcdoc="{framed}" style="width: {width}px; height: 900px; border: 0"></iframe>'
    path = directory / "frame.html"
    path.write_text(f'<!DOCTYPE html><body style="margin: 0"><pre id="found"></pre>{frame}')
    document, said = browse(path, *options)
    (found,) = re.findall(r'<pre id="found">(.*?)</pre>', document, re.S)
    return json.loads(unescape(found)), said


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("kind", [*SETTINGS, "study"])
def test_the_page_in_a_browser(pages, kind, width, tmp_path):
    found, said = measured(pages[kind], width, tmp_path)
    assert width - 20 <= found["width"] <= width
    assert not found["scrolls"] and found["outside"] == []
    assert found["overlapping"] == [] and found["cutOff"] == []
    assert found["pictures"] and all(min(sizes) > 100 for sizes in found["pictures"])
    assert found["texts"] > 20
    assert found["fetched"] == [] and said == []
    assert (found["ink"], found["paper"]) == LIGHT
