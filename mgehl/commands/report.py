"""mgehl report: make one HTML page of a run or a study

Write a run or a study as one HTML page that needs no other file and no network: verdict, films, checks,
pictures, history, configuration, versions. Without --out the page is report.html in the directory, and
one that is there is replaced.

example: python -m mgehl report runs/try --out try.html
"""

from pathlib import Path

from mgehl.errors import OutputError


def add(parser):
    parser.add_argument("directory", metavar="RUN|STUDY", help="directory of a run or a study")
    parser.add_argument(
        "--out", metavar="FILE.html", help="the page (default: report.html beside the results)"
    )
    parser.add_argument("--force", action="store_true", help="replace the file of --out where it exists")


def execute(options):
    """Write the page and say where it is."""
    from mgehl.output.files import REPORT
    from mgehl.output.whole_file import write_whole

    directory = Path(options.directory)
    path = Path(options.out) if options.out else directory / REPORT
    if options.out and path.exists() and not options.force:
        raise OutputError(f"{path} exists: add --force to replace it, or choose another with --out")
    write_whole(path, _page(directory))
    print(f"report {path}")


def _page(directory):
    from mgehl.output.report.page import render
    from mgehl.output.report.run_report import report
    from mgehl.output.report.study_report import is_study, study_report
    from mgehl.output.stored import read_run
    from mgehl.studies.catalogue import WHAT

    if is_study(directory):
        return render(study_report(directory, WHAT))
    return report(read_run(directory), directory.resolve().name)
