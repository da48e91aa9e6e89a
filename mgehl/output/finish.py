"""How a run is finished, with result and picture, and how one that was stopped is taken up."""

from pathlib import Path

from mgehl.errors import one_line
from mgehl.output import files
from mgehl.output.checkpoint import START, read_begun
from mgehl.output.directory import FINISHED, clear_checkpoint, made_before, publish
from mgehl.output.frames import write_frames
from mgehl.output.laws import as_they_were, laws_of, put_files
from mgehl.output.series import title_of, write_series
from mgehl.output.stored import read_run, read_texts
from mgehl.output.whole_file import whole_file, write_whole, writing
from mgehl.saying import complain


def finish_run(comm, directory, solution, picture=True):
    """Replace the run in the directory by the files of a `Solution`, remove the checkpoint (collective).
    Raises OutputError where the disk does not take them; the run before and the checkpoint stay then."""
    files.on_first_rank(comm, _finish, Path(directory), solution, picture)


def _finish(directory, solution, picture):
    stage, texts = directory / files.CHECKPOINT / FINISHED, files.texts_of(solution)
    with writing(directory):
        stage.mkdir(parents=True, exist_ok=True)
        begun = read_begun(directory)
        kept = {name: (stage.parent / name).read_bytes() for name in begun.origins} if begun else {}
        laws = kept if begun else laws_of(solution.config)
        put_files(stage, laws)
        for name, text in texts.items():
            write_whole(stage / name, text)
        with whole_file(stage / files.FIELDS) as part:
            files.write_fields(part, solution, texts)
        names, title = [files.FIELDS, *texts, *laws], title_of(solution.config)
        if solution.config.is_in_time and solution.rows:
            write_series(stage / files.SERIES, solution.rows, title)
            names.append(files.SERIES)
            if solution.frames:
                write_frames(stage / files.FRAMES, solution.frames.all(), solution.x, solution.y, title)
                names.append(files.FRAMES)
        if picture and _is_drawn(stage / files.PICTURE, solution, directory):
            names.append(files.PICTURE)
        made = made_before(directory)
        publish(directory, stage, names)
    if made:
        complain(f"{directory}: of the run that was there before are still {', '.join(made)}")
    clear_checkpoint(directory)


def _is_drawn(path, solution, directory):
    """Whether the picture could be drawn. Where that fails, a message says so, and all else goes on."""
    try:
        from mgehl.output.pictures.figures import run_picture  # matplotlib is slow to import

        content = run_picture(solution)
        with whole_file(path) as part:
            part.write_bytes(content)
        return True
    except Exception as error:  # what matplotlib raises is anybody's guess
        complain(
            f"{directory / files.PICTURE}: cannot be drawn: {one_line(error)}; the results are there, and "
            f"mgehl run --resume {directory} draws it again"
        )
        return False


def draw_missing(directory):
    """Draw the picture of a finished run if it has none, remove its checkpoint; return the result."""
    solution, path = read_run(directory), Path(directory) / files.PICTURE
    clear_checkpoint(directory)
    if not path.exists():
        _is_drawn(path, solution, Path(directory))
    return solution.result


def taken_up(directory):
    """(configuration, `Solution` that was started from, messages) of a run to go on with.

    The configuration is None where the run has finished, the start where it did not start from another
    run. Raises OutputError.
    """
    begun = read_begun(directory)
    if begun is None:
        read_texts(directory)
        return None, None, []
    folder = Path(directory) / files.CHECKPOINT
    with writing(directory):
        config, said = as_they_were(begun, folder, directory)
    return config, read_run(folder / START) if begun.has_start else None, said
