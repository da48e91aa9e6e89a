"""Two writers of one directory, and kills at any moment: what is there is whole, and nothing is lost."""

import shutil
import signal
import time

from attack_ground import LIMIT, command, judge

RUN = ["run", "--set", "grid.nodes=65", "--set", "solver.start=film", "--no-error", "--quiet"]


def attack_writers(count, chance, folder, findings):
    """Two runs of other speeds in one directory; what is there in the end is one of them, whole."""
    from mgehl.output.stored import read_run

    for number in findings.rounds(count):
        out = f"both{number}"
        first = command([*RUN, "--out", out, "--set", "motion.speed=0.5"])
        time.sleep(chance.uniform(0.0, 2.5))
        second = command([*RUN, "--out", out, "--force", "--set", "motion.speed=0.7"])
        ends = []
        for process in (first, second):
            _, err = process.communicate(timeout=LIMIT)
            ends.append(process.returncode)
            judge(findings, [out], process.returncode, err)
        if 0 not in ends:
            findings.say(f"neither wrote: {ends}")
            continue
        solution = read_run(folder / out)
        known = films()[solution.config.motion.speed]
        if abs(solution.result.central_film_nm / known - 1.0) > 1e-6:
            findings.say(f"false result in {out}: {solution.result.central_film_nm} for {known}")


def attack_kills(count, chance, folder, findings, ranks=1):
    """SIGKILL at any moment, with --resume or --force after it; the end is the same."""
    run = [*RUN, "--save-every", "0.001", "--set", "motion.speed=0.5"]
    anew = [*run, "--out", "here", "--force"]
    resumed = ["run", "--resume", "here", "--quiet"]
    here, saved = folder / "here", folder / "here" / "checkpoint" / "begun.npz"
    started = time.monotonic()
    if status := command([*run, "--out", "whole"], ranks).wait():
        findings.say(f"the run without a kill: {status}")
    usual = time.monotonic() - started
    killed, killed_when_saved = 0, 0
    while killed < count:
        is_begun = saved.exists() or (here / "fields.h5").exists()
        process = command(resumed if is_begun else anew, ranks)
        _wait_for_a_moment(chance, process, here / "checkpoint", usual)
        is_saved = is_begun or saved.exists()
        process.kill()
        _, err = process.communicate(timeout=LIMIT)
        findings.tried(process.returncode)
        if process.returncode == -signal.SIGKILL:
            killed += 1
            killed_when_saved += is_saved
        else:
            _judge_film(findings, here, process, err)
            shutil.rmtree(here, ignore_errors=True)
        time.sleep(0.3 if ranks > 1 else 0.0)
    findings.counts["kills after it had begun"] = killed_when_saved
    process = command(resumed if saved.exists() else anew)
    _, err = process.communicate(timeout=LIMIT)
    _judge_film(findings, here, process, err)


def _wait_for_a_moment(chance, process, checkpoint, usual):
    """Any moment of a run that usually takes so long; most of it is imports, so mostly one after these."""
    started = time.monotonic()
    if chance.random() < 0.25:
        time.sleep(chance.uniform(0.1, 1.1) * usual)
        return
    before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else None
    while process.poll() is None and time.monotonic() - started < LIMIT:
        if checkpoint.exists() and checkpoint.stat().st_mtime_ns != before:
            break
        time.sleep(0.001)
    time.sleep(chance.uniform(0.0, 0.3) * usual)


def _judge_film(findings, folder, process, err):
    """A finding where a run failed, or has another film than one that nobody killed."""
    from mgehl.output.stored import read_run

    if process.returncode:
        findings.say(f"after kills: {process.returncode}: {err}")
    elif abs(read_run(folder).result.central_film_nm / films()[0.5] - 1.0) > 1e-9:
        findings.say("another film after kills")


def films(known={}):  # noqa: B006  (solved once)
    """{speed: central film} of both."""
    import mgehl

    for speed in () if known else (0.5, 0.7):
        settings = {"grid.nodes": 65, "solver.start": "film", "solver.error": False, "motion.speed": speed}
        known[speed] = mgehl.solve(mgehl.load(None, settings)).result.central_film_nm
    return known
